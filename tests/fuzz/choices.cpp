#include "tests/fuzz/choices.h"

#include <cfloat>
#include <climits>
#include <cmath>
#include <cstdio>

namespace fuzz {

std::uint32_t roll(const std::uint8_t* data, std::size_t size, std::uint32_t n) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ data[i]) * 1099511628211u;
  return std::uint32_t((hash >> 32) % n);
}

double extreme_number(Choices& choices) {
  static const std::vector<double> kNumbers{0.0,
                                            1e300,
                                            1e-300,
                                            1e90,
                                            1.0000001e90,
                                            1e-90,
                                            9.99e-91,
                                            1e100,
                                            1e-100,
                                            DBL_MAX,
                                            DBL_MIN,
                                            5e-324,
                                            DBL_EPSILON,
                                            INFINITY,
                                            NAN,
                                            9007199254740992.0,
                                            1e15,
                                            1e9,
                                            1e-9,
                                            FLT_MAX,
                                            1e39,
                                            FLT_MIN,
                                            1e-45,
                                            2147483648.0,
                                            2147483647.0,
                                            4294967296.0,
                                            9.3e18,
                                            1.8e19,
                                            140737488355328.0,
                                            33554432.0,
                                            1e-15,
                                            1.0 / 3,
                                            0.1,
                                            1 + DBL_EPSILON,
                                            16777217,
                                            1e22,
                                            1e-22,
                                            65536,
                                            1e5,
                                            12345678.9};
  if (choices.once_in(16)) return choices.raw<double>();
  const double value = choices.of(kNumbers);
  return choices.once_in(3) ? -value : value;
}

std::int64_t extreme_integer(Choices& choices) {
  static const std::vector<std::int64_t> kNumbers{0,
                                                  1,
                                                  -1,
                                                  INT32_MAX,
                                                  INT32_MIN,
                                                  UINT32_MAX,
                                                  std::int64_t(UINT32_MAX) + 1,
                                                  INT64_MAX,
                                                  INT64_MIN,
                                                  std::int64_t(1) << 47,
                                                  -(std::int64_t(1) << 47),
                                                  (std::int64_t(1) << 47) + 1,
                                                  (std::int64_t(1) << 53) + 1,
                                                  1 << 25,
                                                  -(1 << 25),
                                                  (1 << 25) - 1,
                                                  255,
                                                  256,
                                                  65535,
                                                  65536,
                                                  0x7ffffffe,
                                                  0x80000000ll,
                                                  1 << 30,
                                                  4096,
                                                  4097,
                                                  (std::int64_t(1) << 62) + 1,
                                                  INT64_MAX / 12,
                                                  0x15555556,
                                                  1431655766};
  return choices.once_in(16) ? choices.raw<std::int64_t>() : choices.of(kNumbers);
}

std::string extreme_text(Choices& choices) {
  static const std::vector<std::string> kTexts{"nan",
                                               "inf",
                                               "-inf",
                                               "1e999",
                                               "-1e999",
                                               "1e-999",
                                               "0x1p3",
                                               "",
                                               "-",
                                               "+1",
                                               "1,5",
                                               "1e",
                                               "1e+",
                                               ".5",
                                               "5.",
                                               "--1",
                                               "1_000",
                                               "1 2",
                                               "\xef\xbf\xbd",
                                               "0x7fffffffffffffff",
                                               "-0",
                                               "00001",
                                               "1.0.0",
                                               "99999999999999999999999999999999999999",
                                               "0." + std::string(400, '0') + "1",
                                               std::string(400, '9'),
                                               "Infinity"};
  switch (choices.below(3)) {
    case 0:
      return text_of(extreme_number(choices));
    case 1:
      return std::to_string(extreme_integer(choices));
    default:
      return choices.of(kTexts);
  }
}

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace fuzz
