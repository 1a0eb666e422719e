#include "tests/catch.h"
#include "tools/notes/face_notes.h"

using namespace bp;

TEST_CASE("clearly fewer faces than were asked for are noted, and only those", "[quick][tools]") {
  CHECK(too_few_note(1652, 20000).rfind("1652 faces instead of 20000: ", 0) == 0);
  CHECK(!too_few_note(949, 1000).empty());
  CHECK(too_few_note(950, 1000).empty());
  CHECK(too_few_note(1000, 1000).empty());
  CHECK(too_few_note(1100, 1000).empty());  // another note's business
  CHECK(too_few_note(12, 13).empty());      // closed surfaces have an even number
  CHECK(!too_few_note(12, 14).empty());
  CHECK(too_few_note(12, 0).empty());
}

TEST_CASE("what there is to be done about faces fits the mode, and what there is", "[quick][tools]") {
  const auto says = [](const std::string& note, const char* words) { return note.find(words) != std::string::npos; };
  CHECK(says(merged_note(100, 3, 0, {MeshMode::bounding}), "joins parts"));
  CHECK_FALSE(says(merged_note(100, 3, 0, {MeshMode::bounding}), "holes"));
  CHECK(says(merged_note(100, 1, 2, {MeshMode::bounding}), "closes holes"));
  CHECK(says(merged_note(100, 3, 2, {MeshMode::bounding}), "joins parts and closes holes"));
  CHECK(says(merged_note(100, 3, 2, {MeshMode::inside}), "leaves narrow parts out"));
  CHECK_FALSE(says(merged_note(100, 3, 2, {MeshMode::inside}), "joins"));
  CHECK_FALSE(says(merged_note(100, 1, 2, {MeshMode::inside}), "narrow parts"));
  for (const MeshMode mode : {MeshMode::bounding, MeshMode::inside, MeshMode::fit})
    CHECK_FALSE(says(merged_note(100, 1, 0, {mode}), "arts and handles"));
  CHECK_FALSE(says(merged_note(4, 1, 0, {MeshMode::inside}), "--scale"));
  CHECK(says(too_few_note(12, 40, {MeshMode::inside}), "inside"));
}

TEST_CASE("a mesh whose volume is far from that of its voxels is told of", "[quick][tools]") {
  const std::string text = loose_note(200, 7.824, 1, 6, {MeshMode::bounding});
  CHECK(text.rfind("200 faces hold 7.82 times the volume", 0) == 0);
  CHECK(text.find("--scale closes holes") != std::string::npos);
  CHECK(loose_note(200, 1.99, 1, 6, {MeshMode::bounding}).empty());
  CHECK(loose_note(200, 7, 1, 6, {MeshMode::fit}).empty());
  CHECK(!loose_note(200, 0.49, 3, 0, {MeshMode::inside}).empty());
  CHECK(loose_note(200, 0.51, 3, 0, {MeshMode::inside}).empty());
}

TEST_CASE("a note names the scale as its reader can set it", "[quick][tools]") {
  const FaceAdvice lod, pipe{MeshMode::bounding, "bpclose --scale"}, unclosed{MeshMode::bounding, ""};
  for (const bool few : {false, true}) {
    const auto note = [&](const FaceAdvice& a) { return few ? too_few_note(12, 40, a) : least_volume_note(12, 40, a); };
    CHECK(note(lod).ends_with("; smaller voxels, or a smaller --scale, show more of the scene"));
    CHECK(note(pipe).ends_with("; smaller voxels, or a smaller bpclose --scale, show more of the scene"));
    CHECK(note(unclosed).ends_with("; smaller voxels show more of the scene"));
  }
  CHECK(merged_note(100, 3, 0, pipe).ends_with("a larger bpclose --scale joins parts"));
  CHECK(merged_note(100, 3, 0, unclosed).ends_with("; bpclose joins parts"));
  CHECK(loose_note(200, 7, 1, 6, pipe).ends_with("and a larger bpclose --scale closes holes"));
}

TEST_CASE("no voxels show more where a proxy is the scene", "[quick][tools]") {
  FaceAdvice advice;
  advice.exact = true;
  CHECK(too_few_note(12, 40, advice).find(';') == std::string::npos);
  CHECK(least_volume_note(12, 40, advice).find(';') == std::string::npos);
}
