// Writes streams that no writer of the suite would: any value in any field, with hashes and counts that fit.
#include <algorithm>

#include "io/stream/stream_format.h"
#include "tests/fuzz/hostile_stream.h"

namespace fuzz {

namespace {

using namespace bp::detail;

void append(std::string& out, const std::vector<std::byte>& bytes) {
  out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::vector<std::byte> header_of(const RawStream& s) {
  ByteSink out;
  for (const unsigned char c : kStreamMagic) out.put(c);
  out.put(kStreamVersion);
  out.put(s.flags);
  for (const std::uint8_t c : {s.fill, s.element, s.slab_axis, s.up}) out.put(c);
  out.put(s.voxel);
  for (const std::int64_t o : s.origin) out.put(o);
  for (const double b : s.bounds) out.put(b);
  for (const std::int32_t b : s.box) out.put(b);
  out.put(std::uint32_t(s.scale.size()));
  out.put(std::uint32_t(s.provenance.size()));
  out.put_text(s.scale);
  out.put_text(s.provenance);
  if (!s.orientation.empty()) {
    out.put_text(s.orientation);
    out.put(std::uint32_t(s.orientation.size()));
  }
  return frame_of(std::move(out.bytes()), true);
}

/// Section 5 and 6: bricks [begin, end).
void append_batch(std::string& out, const bp::Brick* begin, const bp::Brick* end, bp::StreamTotals& totals) {
  ByteSink raw, head;
  std::vector<Record> records;
  std::vector<std::byte> planes;
  for (const bp::Brick* b = begin; b != end; ++b) {
    records.push_back({b->coord, b->layer, b->fill});
    put_record(raw, records.back());
    if (b->fill != bp::BrickFill::mixed) continue;
    planes.resize(planes.size() + kBrickBytes);
    to_planes(b->bits, planes.data() + planes.size() - kBrickBytes);
  }
  totals.add(total(records, planes));
  raw.bytes().insert(raw.bytes().end(), planes.begin(), planes.end());
  std::vector<std::byte> packed;
  compress(raw.bytes(), 1, true, packed);
  head.put_text(kBatchTag);
  head.put(std::uint32_t(records.size()));
  head.put(std::uint32_t(raw.bytes().size()));
  head.put(std::uint32_t(packed.size()));
  head.put_coord(begin->coord);
  head.put_coord(end[-1].coord);
  append(out, frame_of(std::move(head.bytes()), false));
  append(out, packed);
}

}  // namespace

std::string bytes_of(const RawStream& s) {
  std::string out;
  append(out, header_of(s));
  const int axis = s.slab_axis % 3;
  bp::StreamTotals totals;
  std::vector<IndexEntry> slabs;
  for (std::size_t i = 0, end = 0; i < s.bricks.size(); i = end) {
    const std::int32_t slab = s.bricks[i].coord[axis];
    for (end = i; end < s.bricks.size() && end - i < kMaxMixed && s.bricks[end].coord[axis] == slab;) ++end;
    if (slabs.empty() || slabs.back().slab != slab) slabs.push_back({slab, 0, out.size(), 0});
    ++slabs.back().batches;
    slabs.back().records += end - i;
    append_batch(out, &s.bricks[i], s.bricks.data() + end, totals);
  }
  const std::uint64_t index_offset = out.size();
  ByteSink index, entries;
  for (const IndexEntry& entry : slabs) put_index_entry(entries, entry);
  index.put_text(kIndexTag);
  index.put(std::uint32_t(slabs.size()));
  index.bytes().insert(index.bytes().end(), entries.bytes().begin(), entries.bytes().end());
  index.put(hash64(entries.bytes()));
  append(out, frame_of(std::move(index.bytes()), false));
  append(out, encode_end(totals, index_offset, out.size() + kFrameHeadBytes + kEndBytes));
  return out;
}

}  // namespace fuzz
