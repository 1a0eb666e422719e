#include "lib/core/error.h"
#include "tests/catch.h"
#include "tools/cli/length.h"

using namespace bp;

TEST_CASE("a length is scene units, a percentage of the diagonal, or voxels", "[quick][tools]") {
  CHECK(parse_length("0.5").in_world(10, 2) == 0.5);
  CHECK(parse_length("2%").in_world(10, 2) == 0.2);
  CHECK(parse_length("20vx").in_world(10, 2) == 40);
  CHECK(parse_length("1e-3").in_world(0, 0) == 1e-3);
  CHECK_THROWS_AS(parse_length("2%").in_world(0, 2), Error);
  CHECK_THROWS_AS(parse_length("20vx").in_world(10, 0), Error);
}

TEST_CASE("a length reads back from its own text", "[quick][tools]") {
  const std::string text = GENERATE("0.1", "2%", "20vx", "1e-300", "123456789.125%");
  CHECK(parse_length(parse_length(text).text()) == parse_length(text));
}

TEST_CASE("what is not a length is refused", "[quick][tools]") {
  const std::string text = GENERATE("", " 1", "1 ", "1m", "%", "vx", "1v", "1%%", "-1", "-0.001vx", "nan", "inf",
                                    "-inf", "1e999", "0x10", "1,5", "+1", "--");
  CAPTURE(text);
  CHECK_THROWS_AS(parse_length(text), Error);
}

TEST_CASE("who names a unit of length is told that scenes do not", "[quick][tools]") {
  const std::string text = GENERATE("10cm", "1m", "0.5MM", "3ft");
  CAPTURE(text);
  CHECK_THROWS_WITH(parse_length(text), ContainsSubstring("'" + text +
                                                          "' is not a length such as 0.5, 2% or 20vx; "
                                                          "a scene does not name its unit"));
  CHECK_THROWS_WITH(parse_length("3px"), "'3px' is not a length such as 0.5, 2% or 20vx");
  CHECK_THROWS_WITH(parse_length("3 %"), "'3 %' is not a length such as 0.5, 2% or 20vx");
}

TEST_CASE("a point is three numbers", "[quick][tools]") {
  CHECK(parse_point("1,-2.5,3e6") == Vec3d{1, -2.5, 3e6});
  const std::string text = GENERATE("", "1", "1,2", "1,2,", "1,2,3,", "1,2,3,4", "1, 2,3", "a,b,c", ",,", "1;2;3");
  CAPTURE(text);
  CHECK_THROWS_AS(parse_point(text), Error);
}

TEST_CASE("a whole number out of range is named with the range that matters", "[quick][tools]") {
  CHECK(parse_integer("9223372036854775807", 0, INT64_MAX) == INT64_MAX);
  CHECK_THROWS_WITH(parse_integer("9223372036854775808", 0, INT64_MAX), "'9223372036854775808' is too large a number");
  CHECK_THROWS_WITH(parse_integer("-1", 0, INT64_MAX), "'-1' is not a whole number of at least 0");
  CHECK_THROWS_WITH(parse_integer("1e3", 0, INT64_MAX), "'1e3' is not a whole number of at least 0");
  CHECK_THROWS_WITH(parse_integer("", 0, INT64_MAX), "'' is not a whole number of at least 0");
  CHECK_THROWS_WITH(parse_integer("99999999999999999999", 0, 64),
                    "'99999999999999999999' is not a whole number from 0 to 64");
}

TEST_CASE("a count may be in thousands, millions or billions", "[quick][tools]") {
  CHECK(parse_count("17", 0, 100) == 17);
  CHECK(parse_count("2k", 0, INT64_MAX) == 2000);
  CHECK(parse_count("4.35k", 0, INT64_MAX) == 4350);
  CHECK(parse_count("2K", 0, INT64_MAX) == 2000);
  CHECK(parse_count("2M", 0, INT64_MAX) == 2000000);
  CHECK(parse_count("0.5G", 0, INT64_MAX) == 500000000);
  const std::string text = GENERATE("k", "", "-1k", "1.0005k", "1 k", "1kk", "1e3", "nank", "1e300G", "5m");
  CAPTURE(text);
  CHECK_THROWS_AS(parse_count(text, 0, INT64_MAX), Error);
}

TEST_CASE("sizes are powers of 1024", "[quick][tools]") {
  CHECK(parse_size("4096") == 4096);
  CHECK(parse_size("1K") == 1024);
  CHECK(parse_size("1.5M") == 3u << 19);
  CHECK(parse_size("4G") == std::uint64_t(4) << 30);
  CHECK(parse_size("4GiB") == std::uint64_t(4) << 30);
  CHECK(parse_size("2TB") == std::uint64_t(2) << 40);
  CHECK(parse_size("7B") == 7);
  CHECK(size_text(3u << 19) == "1.5 MiB");
  CHECK(size_text(17) == "17 B");
}

TEST_CASE("what is not a size is refused", "[quick][tools]") {
  const std::string text = GENERATE("", "G", "-1G", "4g", "4Gi", "4 G", "nan", "1e30", "9999999999T", "4GG", "4iB");
  CAPTURE(text);
  CHECK_THROWS_AS(parse_size(text), Error);
}

TEST_CASE("an error may be a pixel of a size on screen, and nothing else may", "[quick][tools]") {
  const Length error = parse_error_length("800px");
  CHECK(error.in_world(400, 0) == 0.5);
  CHECK(error.text() == "800px");
  CHECK_THROWS_AS(parse_error_length("0px"), Error);
  CHECK_THROWS_AS(parse_length("800px"), Error);
}
