#include "lib/core/error.h"
#include "tests/catch.h"
#include "tools/cli/face_list.h"

using namespace bp;

namespace {

std::string refusal(const std::string& text, bool shares = false) {
  try {
    shares ? (void)parse_face_shares(text) : (void)parse_face_list(text);
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    return e.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("faces may be in thousands", "[quick][tools]") {
  CHECK(parse_face_list("2k,500") == std::vector<std::uint64_t>{2000, 500});
  CHECK(parse_face_list("1.5M,20k,999") == std::vector<std::uint64_t>{1500000, 20000, 999});
  CHECK_THROWS_AS(parse_face_list("500,2k"), Error);
}

TEST_CASE("a list of faces falls from level to level", "[quick][tools]") {
  CHECK(parse_face_list("1000") == std::vector<std::uint64_t>{1000});
  CHECK(parse_face_list("900,100,20") == std::vector<std::uint64_t>{900, 100, 20});
  CHECK(refusal("12,40") == "12,40: each level must have fewer than the one before");
  CHECK(refusal("40,40") == "40,40: each level must have fewer than the one before");
  CHECK(refusal("0") == "0: a level must have faces");
  CHECK(refusal("12,") == "'' is not a whole number of at least 0");
  CHECK(refusal("12, 5") == "' 5' is not a whole number of at least 0");
  CHECK(refusal("-12,5") == "'-12' is not a whole number of at least 0");
}

TEST_CASE("one number with its digits in groups is told from a list", "[quick][tools]") {
  CHECK(refusal("1,000") == "1,000: a level must have faces; commas part levels, so if it is one number, write 1000");
  CHECK(refusal("20,000,000").ends_with(" write 20000000"));
  CHECK(
      refusal("1,500") ==
      "1,500: each level must have fewer than the one before; commas part levels, so if it is one number, write 1500");
  CHECK(refusal("1000,000") == "1000,000: a level must have faces");
  CHECK(refusal("10,00") == "10,00: a level must have faces");
  CHECK(refusal("1,000,00") == "1,000,00: a level must have faces");
}

TEST_CASE("percentages of the scene fall from level to level", "[quick][tools]") {
  CHECK(parse_face_shares("50%") == std::vector<double>{50});
  CHECK(parse_face_shares("100%,12.5%,0.1%") == std::vector<double>{100, 12.5, 0.1});
  CHECK(refusal("10%,40%", true) == "10%,40%: each level must have fewer than the one before");
  CHECK(refusal("50%,100", true) == "50%,100: mixes numbers and percentages of the scene's triangles; use one of them");
  CHECK(refusal("0%", true) == "0%: a share of the scene's triangles must be above 0% and at most 100%");
  CHECK(refusal("101%", true) == "101%: a share of the scene's triangles must be above 0% and at most 100%");
  CHECK(refusal("%", true) == "'' is not a number");
}
