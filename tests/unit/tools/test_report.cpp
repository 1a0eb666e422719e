#include "tests/catch.h"
#include "tools/cli/report.h"

using namespace bp;

TEST_CASE("a report keeps the order of its keys and measures its stages", "[quick][tools]") {
  Report report("bptest");
  report.options["scale"] = "2%";
  report.counts["zebra"] = 1;
  report.counts["ant"] = 2;
  report.begin("read");
  report.begin("write");
  report.begin("read");
  const Json json = Json::parse(report.text());
  CHECK(json["tool"] == "bptest");
  CHECK(json["counts"].begin().key() == "zebra");
  CHECK(json["seconds"].size() == 3);  // read, write, total
  CHECK(json["peak_memory_bytes"].get<std::uint64_t>() > (1u << 20));
  CHECK(json["seconds"]["total"].get<double>() >= json["seconds"]["read"].get<double>());
}

TEST_CASE("a report survives names that are not UTF-8", "[quick][tools]") {
  Report report("bptest");
  report.options["input"] = "\xff\xfe.ply";
  CHECK_NOTHROW(Json::parse(report.text()));
}
