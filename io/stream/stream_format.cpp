#include "io/stream/stream_format.h"

#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/stream/detail/stream_orientation.h"
#include "io/stream/detail/stream_scene.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/count_bits.h"
#include "lib/grid/header_fault.h"

namespace bp::detail {

namespace {

using Json = nlohmann::ordered_json;

XXH3_state_t* new_hash_state() {
  XXH3_state_t* state = XXH3_createState();
  if (state == nullptr) fail(ErrorCode::out_of_resource, "no memory for a hash");
  return state;
}

std::string provenance_text(const std::vector<Provenance>& chain) {
  Json list = Json::array();
  for (const Provenance& p : chain) {
    list.push_back(
        Json{{"tool", p.tool}, {"version", p.version}, {"options", p.options}, {"input_hash", p.input_hash}});
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<Provenance> provenance_of(const std::string& text, const std::string& name) {
  const auto damaged = [&]() {
    fail(ErrorCode::bad_input, "{}: header: the provenance is not what it should be", name);
  };
  const Json::parser_callback_t shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > 3) damaged();
    return true;
  };
  std::vector<Provenance> chain;
  try {
    const Json list = Json::parse(text, shallow);
    if (!list.is_array()) damaged();
    for (const Json& step : list) {
      if (!step.is_object() || step.size() != 4) damaged();
      chain.push_back({step.at("tool").get<std::string>(), step.at("version").get<std::string>(),
                       step.at("options").get<std::string>(), step.at("input_hash").get<std::string>()});
    }
  } catch (const nlohmann::json::exception&) {
    damaged();
  }
  return chain;
}

ScaleField field_of(const std::string& text, const GridFrame& frame, const std::string& name) {
  ScaleField field = parse_scale_field(text, name);
  try {
    (void)field.upper_bound(frame);
  } catch (const Error& e) {
    fail(ErrorCode::bad_input, "{}: header: {}", name, e.what());
  }
  return field;
}

/// Returns enumerator `value`. Throws bad_input if there are not that many.
template <class Enum>
Enum enum_of(std::uint8_t value, int count, const char* what, const std::string& name) {
  if (value >= count) fail(ErrorCode::bad_input, "{}: header: unknown {} {}; update this tool", name, what, value);
  return Enum(value);
}

}  // namespace

std::uint64_t hash64(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

void FreeHashState::operator()(void* state) const {
  XXH3_freeState(static_cast<XXH3_state_t*>(state));
}

Digest::Digest() : state_(new_hash_state()) {
  XXH3_64bits_reset(static_cast<XXH3_state_t*>(state_.get()));
}
void Digest::add(std::span<const std::byte> bytes) {
  XXH3_64bits_update(static_cast<XXH3_state_t*>(state_.get()), bytes.data(), bytes.size());
}
std::uint64_t Digest::hash() const {
  return XXH3_64bits_digest(static_cast<const XXH3_state_t*>(state_.get()));
}

std::size_t batches_ahead() {
  return std::size_t(std::clamp(thread_count(), 1, 8));
}

bool seal_holds(std::span<const std::byte> payload) {
  const std::size_t n = payload.size() - kHashBytes;
  return ByteSource(payload.subspan(n)).get<std::uint64_t>() == hash64(payload.first(n));
}

std::vector<std::byte> frame_of(std::vector<std::byte> payload, bool sealed) {
  ByteSink frame;
  frame.put(kFrameMagic);
  frame.put(std::uint32_t(payload.size() + (sealed ? kHashBytes : 0)));
  frame.bytes().insert(frame.bytes().end(), payload.begin(), payload.end());
  if (sealed) frame.put(hash64(payload));
  return std::move(frame.bytes());
}

std::vector<std::byte> encode_header(const StreamHeader& h) {
  if (const char* fault = header_fault(h)) fail(ErrorCode::bad_argument, "the stream cannot be written: {}", fault);
  const std::string scale = h.has_closing || h.has_field ? to_json(h.scale) : "",
                    provenance = provenance_text(h.provenance);
  const std::string scene = scene_text(h.scene);
  if (scale.size() > kMaxScaleBytes || provenance.size() > kMaxProvenanceBytes) {
    fail(ErrorCode::bad_argument,
         "the stream cannot be written: {} bytes of scale field and {} of provenance; at most {} and {}", scale.size(),
         provenance.size(), kMaxScaleBytes, kMaxProvenanceBytes);
  }
  const bool oriented = (h.has_closing || h.has_field) && !h.orientation.empty();
  ByteSink out;
  for (const unsigned char c : kStreamMagic) out.put(c);
  out.put(kStreamVersion);
  out.put(std::uint16_t((h.has_closing ? kFlagClosing : 0) | (scene.empty() ? 0 : kFlagScene) |
                        (h.has_field && !h.has_closing ? kFlagField : 0) | (oriented ? kFlagOrientation : 0)));
  out.put(std::uint8_t(h.fill));
  out.put(std::uint8_t(h.has_closing ? h.element : StructuringElement::ball));
  out.put(std::uint8_t(h.slab_axis));
  out.put(std::uint8_t(h.frame.up));
  out.put(h.frame.voxel);
  for (const std::int64_t o : h.frame.origin) out.put(o);
  for (const double c : h.bounds.min) out.put(c);
  for (const double c : h.bounds.max) out.put(c);
  out.put_coord(h.bricks.min);
  out.put_coord(h.bricks.max);
  out.put(std::uint32_t(scale.size()));
  out.put(std::uint32_t(provenance.size()));
  out.put_text(scale);
  out.put_text(provenance);
  out.put_text(scene);
  if (oriented) put_orientation(out, h.orientation);
  return std::move(out.bytes());
}

StreamHeader decode_header(std::span<const std::byte> payload, const std::string& name) {
  ByteSource in(payload.subspan(kStreamMagic.size() + 2));
  StreamHeader h;
  const auto flags = in.get<std::uint16_t>();
  if ((flags & ~(kFlagClosing | kFlagScene | kFlagField | kFlagOrientation)) != 0)
    fail(ErrorCode::bad_input, "{}: header: has flags of a later version; update this tool", name);
  h.has_closing = (flags & kFlagClosing) != 0;
  h.has_field = (flags & kFlagField) != 0;
  if (h.has_closing && h.has_field)
    fail(ErrorCode::bad_input, "{}: header: a closing, and a scale field for a closing to come", name);
  h.fill = enum_of<FillMode>(in.get<std::uint8_t>(), 4, "fill mode", name);
  const auto element = enum_of<StructuringElement>(in.get<std::uint8_t>(), h.has_closing ? 2 : 1, "element", name);
  if (h.has_closing) h.element = element;
  h.slab_axis = in.get<std::uint8_t>();
  h.frame.up = UpAxis(enum_of<int>(in.get<std::uint8_t>(), int(kUpNames.size()), "up axis", name));
  h.frame.voxel = in.get<double>();
  for (std::int64_t& o : h.frame.origin) o = in.get<std::int64_t>();
  for (double& c : h.bounds.min) c = in.get<double>();
  for (double& c : h.bounds.max) c = in.get<double>();
  h.bricks.min = in.get_coord();
  h.bricks.max = in.get_coord();
  const auto scale_bytes = in.get<std::uint32_t>(), provenance_bytes = in.get<std::uint32_t>();
  const std::string scale = in.get_text(scale_bytes);
  if ((h.has_closing || h.has_field) != !scale.empty())
    fail(ErrorCode::bad_input, "{}: header: a scale field without its flag or a closing, or one of them without it",
         name);
  h.provenance = provenance_of(in.get_text(provenance_bytes), name);
  if (const char* fault = header_fault(h))
    fail(ErrorCode::bad_input, "{}: header: {}; make the stream anew", name, fault);
  if (!scale.empty()) h.scale = field_of(scale, h.frame, name);
  std::span<const std::byte> rest = payload.subspan(kHeaderFixedBytes + scale_bytes + provenance_bytes);
  if ((flags & kFlagOrientation) != 0) take_orientation(rest, h, name);
  const std::size_t scene_bytes = rest.size();
  if (((flags & kFlagScene) != 0) != (scene_bytes > 0))
    fail(ErrorCode::bad_input, "{}: header: scene files without their flag, or the flag without them", name);
  if (scene_bytes > 0) h.scene = scene_of(in.get_text(scene_bytes), name);
  return h;
}

void put_record(ByteSink& sink, const Record& record) {
  sink.put_coord(record.coord);
  sink.put(std::uint8_t(record.layer));
  sink.put(std::uint8_t(record.fill));
  sink.put(std::uint16_t(0));
}

bool before(int slab_axis, const Record& a, const Record& b) {
  if (a.coord == b.coord) return a.layer < b.layer;
  return slab_order(slab_axis, a.coord, b.coord);
}

StreamTotals total(std::span<const Record> records, std::span<const std::byte> planes) {
  static const std::vector<std::byte> ones(kBrickBytes, std::byte(0xff));
  const std::unique_ptr<XXH3_state_t, FreeHashState> state(new_hash_state());
  StreamTotals totals;
  for (const Record& record : records) {
    std::span<const std::byte> data = ones;
    if (record.fill == BrickFill::mixed) {
      data = planes.first(kBrickBytes);
      planes = planes.subspan(kBrickBytes);
    }
    ByteSink head;
    put_record(head, {record.coord, record.layer, BrickFill::empty});
    XXH3_128bits_reset(state.get());
    XXH3_128bits_update(state.get(), head.bytes().data(), head.bytes().size());
    XXH3_128bits_update(state.get(), data.data(), data.size());
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    StreamTotals one;
    one.checksum_low = hash.low64;
    one.checksum_high = hash.high64;
    LayerTotals& layer = one.layers[std::size_t(record.layer)];
    layer.bricks = 1;
    layer.full = record.fill == BrickFill::full;
    layer.voxels = record.fill == BrickFill::full ? kBrickBytes * 8 : count_bits(data);
    totals.add(one);
  }
  return totals;
}

void put_index_entry(ByteSink& sink, const IndexEntry& entry) {
  sink.put(entry.slab);
  sink.put(entry.batches);
  sink.put(entry.offset);
  sink.put(entry.records);
}

void SlabIndex::add(std::int32_t slab, std::uint64_t offset, std::uint64_t records) {
  if (last_.batches > 0 && last_.slab != slab) end();
  if (last_.batches++ == 0) last_ = {slab, 1, offset, 0};
  last_.records += records;
}

void SlabIndex::end() {
  if (last_.batches == 0) return;
  ByteSink bytes;
  put_index_entry(bytes, last_);
  digest_.add(bytes.bytes());
  ++slabs_;
  last_ = {};
}

std::vector<std::byte> encode_end(const StreamTotals& totals, std::uint64_t index_offset, std::uint64_t bytes) {
  ByteSink out;
  out.put_text(kEndTag);
  out.put(std::uint32_t(0));
  for (const LayerTotals& layer : totals.layers) out.put(layer.bricks), out.put(layer.full), out.put(layer.voxels);
  out.put(totals.checksum_low);
  out.put(totals.checksum_high);
  out.put(index_offset);
  out.put(bytes);
  return frame_of(std::move(out.bytes()), true);
}

}  // namespace bp::detail
