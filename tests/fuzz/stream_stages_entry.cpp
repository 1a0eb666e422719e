#include "tests/fuzz/entries.h"
#include "tests/fuzz/hostile_stream.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Words = std::vector<std::string>;

void add(Words& words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// Returns small scales, or hostile ones: those in between are honest work for minutes.
std::string length_text(Choices& c) {
  if (c.once_in(12)) return text_of(extreme_number(c)) + c.of<std::string>({"", "%", "vx"});
  return c.of<std::string>({"1vx", "2vx", "0.5vx", "3.3vx", "5vx", "0.25", "0.7", "1%", "0", "1.0625vx"});
}

Words close_options(Choices& c, Workplace& place, double voxel) {
  Words words;
  if (c.once_in(4)) {
    place.write("field.json", hostile_field(c, voxel));
    add(words, {"--field", place.path("field.json")});
  } else {
    add(words, {"--scale", length_text(c)});
  }
  if (c.once_in(2)) add(words, {"--element", "ball"});
  if (c.once_in(4)) (void)c.below(5);  // an option that is gone: kept findings draw it
  if (c.once_in(4) && c.below(2) == 0) add(words, {"--keep-cavities"});
  return words;
}

Words mesh_options(Choices& c) {
  Words words;
  if (!c.once_in(4))
    add(words, {"--faces", c.of<std::string>({"20", "100,20", "4", "60", "0", "1000000", "200,50,12", "1"})});
  if (c.once_in(4)) add(words, {"--error", length_text(c)});
  if (c.once_in(6)) add(words, {"--volume", c.once_in(2) ? text_of(extreme_number(c)) : "1.2"});
  if (c.once_in(8) && c.once_in(2)) (void)extreme_number(c);  // an option that is gone: kept findings draw it
  if (c.once_in(4)) add(words, {"--mode", c.of<std::string>({"inside", "fit"})});
  if (c.once_in(8)) add(words, {"--enclose", c.of<std::string>({"input", "closing"})});
  for (int gone = 0; gone < 2; ++gone)  // options that are gone, with a number
    if (c.once_in(12) && c.once_in(2)) (void)extreme_number(c);
  (void)c.once_in(12);
  if (c.once_in(12)) add(words, {"--quads"});
  (void)c.once_in(8);
  if (c.once_in(16)) add(words, {"--origin", text_of(extreme_number(c)) + ",0," + text_of(extreme_number(c))});
  return words;
}

/// A proxy holds, whatever the stream: closed, oriented, without intersections.
void check(Workplace& place, const std::string& proxy, const Words& how) {
  const ToolResult verdict = place.run("bpcheck", {place.path(proxy)});
  if (verdict.status == 0) return;
  std::string words;
  for (const std::string& w : how) words += " " + w;
  fail_fuzz(proxy + words, "does not hold: " + verdict.output + verdict.messages);
}

void mesh(Choices& c, Workplace& place, const std::string& stream, bool readable) {
  const std::string extension = c.of<std::string>({"obj", "ply", "glb", "stl"});
  Words words = mesh_options(c), outputs;
  for (int i = 0; i < 3; ++i) outputs.push_back("p." + std::to_string(i) + "." + extension);
  outputs.push_back("p." + extension);
  add(words, {place.path(stream), "-o", place.path("p." + extension)});
  const ToolResult made = place.run("bpmesh", words, outputs);
  if (!made.done()) return;
  if (!readable) fail_fuzz(stream, "bpmesh reads what bpinfo refuses");
  if (extension == "stl") return;  // its numbers are short
  for (const std::string& name : outputs) {
    if (place.has(name)) check(place, name, words);
  }
}

/// Runs bpclose and bpmesh on a stream that bpinfo can read, or cannot.
void close_and_mesh(Choices& c, Workplace& place, const std::string& stream, Words options, bool readable) {
  add(options, {place.path(stream), "-o", place.path("y.bpv")});
  if (!place.run("bpclose", options, {"y.bpv"}).done()) return;
  if (!readable) fail_fuzz(stream, "bpclose reads what bpinfo refuses");
  if (!place.run("bpinfo", {place.path("y.bpv")}).done()) fail_fuzz("y.bpv", "bpclose made what bpinfo refuses");
  mesh(c, place, "y.bpv", true);
}

/// With a field in the header, by the fuzzer or by bpscale; then on through the pipe.
void scale_and_close(Choices& c, Workplace& place, RawStream stream, bool readable) {
  const std::string rules = hostile_rules(c, stream.voxel);
  if ((stream.flags & 1) == 0 && c.once_in(3)) {
    stream.flags |= 4;
    stream.scale = rules;
    place.write("x.bpv", bytes_of(stream));
    readable = place.run("bpinfo", {place.path("x.bpv")}).done();
  } else {
    place.write("rules.json", rules);
    const Words words{place.path("rules.json"), place.path("x.bpv")};
    (void)place.run("bpscale", {words[0], words[1], "--explain", "1,2," + text_of(extreme_number(c))});
    const bool scaled = place.run("bpscale", {words[0], words[1], "-o", place.path("s.bpv")}, {"s.bpv"}).done();
    if (!scaled) return;
    if (!readable) fail_fuzz("x.bpv", "bpscale reads what bpinfo refuses");
    if (!place.run("bpinfo", {place.path("s.bpv")}).done()) fail_fuzz("s.bpv", "bpscale made what bpinfo refuses");
  }
  close_and_mesh(c, place, place.has("s.bpv") ? "s.bpv" : "x.bpv", {}, readable);
}

/// With an orientation: of a closing to come, or of one that is there.
RawStream turned_stream(Choices& c) {
  RawStream s = hostile_stream(c);
  s.orientation = hostile_orientation(c);
  s.flags |= 8;
  if ((s.flags & 1) == 0) {
    s.flags |= 4;
    s.scale =
        c.once_in(8) ? hostile_field(c, s.voxel) : "{\"base\":" + text_of(s.voxel * c.of({1.0, 2.0, 3.5, 6.0})) + "}";
  } else if (!c.once_in(8)) {
    s.element = 1;
  }
  return s;
}

/// Writes a stream, and has bpinfo look at it in one of four ways, or plainly. True if it can be read.
bool look_at(Choices& c, Workplace& place, const RawStream& stream, std::uint32_t way,
             std::initializer_list<std::string> texts) {
  place.write("x.bpv", bytes_of(stream));
  Words info{place.path("x.bpv")};
  if (way == 0) add(info, {"--image", place.path("x.png"), "--image-size", "64"});
  if (way > 0 && way < 4) add(info, {c.of(texts)});
  return place.run("bpinfo", info, {"x.png"}).done();
}

}  // namespace

void turned(const std::uint8_t* data, std::size_t size) {
  Choices c(data, size);
  const std::uint32_t way = roll(data, size, 16);
  const RawStream stream = turned_stream(c);
  Workplace place;
  const bool readable = look_at(c, place, stream, way, {"--json", "--dump"});
  if (way < 4 || way > 8) return;
  if ((stream.flags & 1) != 0) return mesh(c, place, "x.bpv", readable);
  close_and_mesh(c, place, "x.bpv", {}, readable);
}

void stream_stages(const std::uint8_t* data, std::size_t size) {
  Choices c(data, size);
  const std::uint32_t way = roll(data, size, 64);
  const RawStream stream = hostile_stream(c);
  Workplace place;
  const bool readable = look_at(c, place, stream, way, {"--json", "--dump", "--dump"});
  if (way > 4 && way < 14) mesh(c, place, "x.bpv", readable);
  if (way >= 14 && way < 18) close_and_mesh(c, place, "x.bpv", close_options(c, place, stream.voxel), readable);
  if (way >= 18 && way < 22) scale_and_close(c, place, stream, readable);
}

}  // namespace fuzz
