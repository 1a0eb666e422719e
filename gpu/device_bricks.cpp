#include "gpu/device_bricks.h"

#include <cstring>
#include <new>

namespace bp {

namespace {

std::size_t volume(const BrickBox& box) {
  return std::size_t(box.size().x) * std::size_t(box.size().y) * std::size_t(box.size().z);
}

BrickCoord brick_at(const BrickBox& box, std::size_t i) {
  const auto nx = std::size_t(box.size().x), ny = std::size_t(box.size().y);
  return {box.min.x + std::int32_t(i % nx), box.min.y + std::int32_t(i / nx % ny),
          box.min.z + std::int32_t(i / nx / ny)};
}

BrickTable table_of(const BrickBox& box, const BoxOfWords& where) {
  BrickTable t;
  t.nx = box.size().x, t.ny = box.size().y, t.nz = box.size().z;
  t.w0 = where.w0, t.y0 = where.y0, t.z0 = where.z0;
  return t;
}

/// Puts one brick into `closed`. `rows`: words of the brick; null: all ones.
void put_brick(BrickCoord brick, const std::byte* rows, BitBox& closed) {
  const VoxelCoord first = first_voxel(brick);
  const std::int32_t column = (first.x - closed.box().min.x) / kBrickEdge;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      std::uint64_t word = ~std::uint64_t(0);
      if (rows != nullptr) std::memcpy(&word, rows + 8 * (z * kBrickEdge + y), 8);
      closed.row(first.y + y, first.z + z)[column] = word;
    }
  }
}

}  // namespace

BrickTable DeviceBricks::upload(const BrickShelf& solid, const BrickBox& seen, const BoxOfWords& where) {
  const std::size_t n = volume(seen);
  slots_.assign(n, kEmptyBrick);
  std::size_t at = 0, mixed = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const BrickFill fill = solid.fill(brick_at(seen, i));
    if (fill == BrickFill::full) slots_[i] = kFullBrick;
    if (fill == BrickFill::mixed) slots_[i] = std::uint32_t(mixed++);
  }
  BrickTable table = table_of(seen, where);
  table.bits = reinterpret_cast<std::uint64_t*>(in_.grow(n * kBrickWords * 2));
  table.slots = in_slots_.grow(n);
  work_.staging.upload_pieces(table.bits, kBrickWords * 8, mixed, [&](std::byte* piece) {
    while (at < n && slots_[at] >= kFullBrick) ++at;
    if (at == n) return false;
    (void)solid.get(brick_at(seen, at++), *new (piece) BrickBits);
    return true;
  });
  work_.staging.upload(table.slots, slots_.data(), n * sizeof(std::uint32_t));
  return table;
}

BrickTable DeviceBricks::room_for(const BrickBox& made, const BoxOfWords& where) {
  const std::size_t n = volume(made);
  BrickTable table = table_of(made, where);
  table.bits = reinterpret_cast<std::uint64_t*>(out_.grow(n * kBrickWords * 2));
  table.slots = out_slots_.grow(n + 1);
  return table;
}

std::uint32_t* DeviceBricks::count_of(const BrickTable& table) {
  return table.slots + std::size_t(table.nx) * std::size_t(table.ny) * std::size_t(table.nz);
}

void DeviceBricks::download(const BrickTable& table, const BrickBox& made, BitBox& closed) {
  const std::size_t n = volume(made);
  slots_.resize(n + 1);
  work_.staging.download(slots_.data(), table.slots, (n + 1) * sizeof(std::uint32_t));
  const std::size_t mixed = slots_[n];
  std::vector<std::size_t> brick_of(mixed);
  for (std::size_t i = 0; i < n; ++i) {
    if (slots_[i] < kFullBrick) brick_of[slots_[i]] = i;
    if (slots_[i] == kFullBrick) put_brick(brick_at(made, i), nullptr, closed);
  }
  work_.staging.download_blocks(
      table.bits, mixed * kBrickWords * 8, [&](std::size_t first, const std::byte* block, std::size_t bytes) {
        for (std::size_t at = 0; at < bytes; at += kBrickWords * 8)
          put_brick(brick_at(made, brick_of[(first + at) / (kBrickWords * 8)]), block + at, closed);
      });
}

void DeviceBricks::release() {
  for (auto* b : {&in_, &out_, &in_slots_, &out_slots_}) b->release();
}

}  // namespace bp
