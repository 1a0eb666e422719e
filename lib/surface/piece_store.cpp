#include "lib/surface/piece_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace bp {

namespace {

constexpr std::size_t kPutBytes = std::size_t(1) << 20;

/// A vertex relative to the low corner of its cell: a cell is less than 2^31 lattice units wide.
using Offset = std::array<std::uint32_t, 3>;

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// Header (three counts), triangles, offsets of the vertices, quadrics.
std::vector<std::byte> encoded(const Piece& piece) {
  std::vector<Offset> offsets;
  offsets.reserve(piece.vertices.size());
  for (const LatticeCoord& v : piece.vertices) {
    const LatticeCoord d = v - piece.cell.min;
    offsets.push_back({std::uint32_t(d.x), std::uint32_t(d.y), std::uint32_t(d.z)});
  }
  const std::vector<std::uint64_t> counts{piece.triangles.size(), piece.vertices.size(), piece.quadrics.size()};
  std::vector<std::byte> out;
  out.reserve(bytes_of(counts).size() + bytes_of(piece.triangles).size() + bytes_of(offsets).size() +
              bytes_of(piece.quadrics).size());
  for (const auto part : {bytes_of(counts), bytes_of(piece.triangles), bytes_of(offsets), bytes_of(piece.quadrics)})
    out.insert(out.end(), part.begin(), part.end());
  return out;
}

/// Takes n values from the front of `bytes`.
template <class T>
std::vector<T> take_values(std::span<const std::byte>& bytes, std::size_t n) {
  std::vector<T> values(n);
  if (n > 0) std::memcpy(values.data(), bytes.data(), n * sizeof(T));
  bytes = bytes.subspan(n * sizeof(T));
  return values;
}

void decode(std::span<const std::byte> bytes, Piece& piece) {
  const auto counts = take_values<std::uint64_t>(bytes, 3);
  piece.triangles = take_values<std::array<std::uint32_t, 3>>(bytes, counts[0]);
  const auto offsets = take_values<Offset>(bytes, counts[1]);
  piece.quadrics = take_values<Quadric>(bytes, counts[2]);
  piece.vertices.reserve(offsets.size());
  for (const Offset& d : offsets) piece.vertices.push_back(piece.cell.min + LatticeCoord{d[0], d[1], d[2]});
}

}  // namespace

std::uint64_t PieceMemory::limit_for(std::uint64_t whole_bytes, std::uint64_t cell_bytes) const {
  if (!(work_share > 0)) return 0;
  constexpr double kRounded = 4096;  // bytes that shares, rounded to whole ones, may be short of
  const double all = double(std::max(whole_bytes, cell_bytes) + held_bytes) / (work_share + waiting_share);
  return limit.for_rest(std::max(all, double(cell_bytes) / work_share) + kRounded);
}

PieceMemory PieceMemory::without(std::uint64_t bytes) const {
  PieceMemory rest = *this;
  rest.held_bytes += bytes;
  rest.waiting_bytes -= std::min(bytes, waiting_bytes);
  bytes -= waiting_bytes - rest.waiting_bytes;
  rest.work_bytes -= std::min(bytes, work_bytes);
  return rest;
}

PieceMemory PieceMemory::split(std::uint64_t n) const {
  PieceMemory one = *this;
  one.waiting_bytes /= n;
  one.work_bytes /= n;
  one.held_bytes /= n;
  one.waiting_share /= double(n);
  one.work_share /= double(n);
  return one;
}

WaitingPiece PieceStore::put(Piece&& piece) {
  WaitingPiece waiting;
  waiting.faces_ = piece.triangles.size();
  waiting.bytes_ = bytes_of(piece.triangles).size() + bytes_of(piece.vertices).size() + bytes_of(piece.quadrics).size();
  if (reserve(waiting.bytes_)) {
    piece.vertices.shrink_to_fit();
    piece.triangles.shrink_to_fit();
    piece.quadrics.shrink_to_fit();
    waiting.piece_ = std::move(piece);
    return waiting;
  }
  waiting.bytes_ = 0;
  waiting.piece_.cell = piece.cell;
  const std::vector<std::byte> all = encoded(piece);
  piece = {};
  for (std::size_t i = 0; i < all.size(); i += kPutBytes) {
    waiting.in_store_.push_back(store().put(std::span(all).subspan(i, std::min(kPutBytes, all.size() - i))));
  }
  return waiting;
}

Piece PieceStore::take(WaitingPiece&& waiting) {
  Piece piece = std::exchange(waiting.piece_, {});
  if (waiting.in_store_.empty()) {
    const std::lock_guard lock(mutex_);
    used_ -= waiting.bytes_;
    return piece;
  }
  std::vector<std::byte> all, chunk;
  for (const Scratch::Handle handle : waiting.in_store_) {
    store().get(handle, chunk);
    store().drop(handle);
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  decode(all, piece);
  return piece;
}

bool PieceStore::reserve(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (memory_.make_scratch && used_ + bytes > memory_.waiting_bytes) return false;
  used_ += bytes;
  return true;
}

Scratch& PieceStore::store() {
  const std::lock_guard lock(mutex_);
  if (!store_) store_ = memory_.make_scratch();
  return *store_;
}

}  // namespace bp
