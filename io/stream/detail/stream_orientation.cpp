#include "io/stream/detail/stream_orientation.h"

#include "lib/core/error.h"

namespace bp::detail {

namespace {

constexpr std::size_t kFixedBytes = 32, kRotationBytes = 8, kCellBytes = 2, kSizeBytes = 4;

}  // namespace

void put_orientation(ByteSink& sink, const OrientationField& f) {
  sink.put(f.cell_vox);
  for (int axis = 0; axis < 3; ++axis) sink.put(f.origin[axis]);
  for (int axis = 0; axis < 3; ++axis) sink.put(f.size[axis]);
  sink.put(std::uint32_t(f.rotations.size()));
  for (const FixedQuaternion& q : f.rotations) sink.put(q.w), sink.put(q.x), sink.put(q.y), sink.put(q.z);
  for (const std::uint16_t cell : f.cells) sink.put(cell);
  sink.put(std::uint32_t(kFixedBytes + kRotationBytes * f.rotations.size() + kCellBytes * f.cells.size()));
}

void take_orientation(std::span<const std::byte>& rest, StreamHeader& header, const std::string& name) {
  const auto damaged = [&](const char* fact) { fail(ErrorCode::bad_input, "{}: header: {}", name, fact); };
  if (!(header.has_field || (header.has_closing && header.element == StructuringElement::cube)))
    damaged("an orientation without cubes that it turns");
  if (rest.size() < kFixedBytes + kSizeBytes) damaged("the orientation is cut off");
  const std::size_t bytes = ByteSource(rest.last(kSizeBytes)).get<std::uint32_t>();
  rest = rest.first(rest.size() - kSizeBytes);
  if (bytes < kFixedBytes || bytes > rest.size() || bytes > kMaxOrientationBytes) damaged("the orientation is cut off");
  ByteSource in(rest.last(bytes));
  rest = rest.first(rest.size() - bytes);
  OrientationField f;
  f.cell_vox = in.get<std::int32_t>();
  for (int axis = 0; axis < 3; ++axis) f.origin[axis] = in.get<std::int32_t>();
  for (int axis = 0; axis < 3; ++axis) f.size[axis] = in.get<std::int32_t>();
  const std::size_t count = in.get<std::uint32_t>();
  if (count > (bytes - kFixedBytes) / kRotationBytes || (bytes - kFixedBytes) % kCellBytes != 0)
    damaged("the orientation has too few or too many cells");
  for (std::size_t i = 0; i < count; ++i) {
    FixedQuaternion q;
    for (std::int16_t* part : {&q.w, &q.x, &q.y, &q.z}) *part = in.get<std::int16_t>();
    f.rotations.push_back(q);
  }
  for (std::size_t i = (bytes - kFixedBytes - kRotationBytes * count) / kCellBytes; i > 0; --i)
    f.cells.push_back(in.get<std::uint16_t>());
  if (const char* fault = orientation_fault(f)) damaged(fault);
  header.orientation = std::move(f);
}

}  // namespace bp::detail
