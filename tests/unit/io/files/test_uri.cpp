#include "io/files/uri.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("a URI names the file that viewers ask for", "[quick][io]") {
  const auto path = [](const char* uri) { return file_of_uri(uri, "in").path; };
  CHECK(path("a.glb") == "in/a.glb");
  CHECK(path("wall%20of%20brick.png") == "in/wall of brick.png");
  CHECK(path("wall of brick.png") == "in/wall of brick.png");
  CHECK(path("a.glb?v=7") == "in/a.glb");
  CHECK(path("a.glb#part?") == "in/a.glb");
  CHECK(path("a%3Fv=7.glb") == "in/a?v=7.glb");  // a file of this name
  CHECK(path("x/../y/./a.glb") == "in/y/a.glb");
  CHECK(path("%2e%2e/a.glb") == "in/../a.glb");
  CHECK(path("a:b/../c.glb").empty());
  CHECK(path("y/a:b.glb") == "in/y/a:b.glb");
  CHECK(file_of_uri("a.glb", "").path == "a.glb");
}

TEST_CASE("a URI that programs take in different ways names no file", "[quick][io]") {
  for (const char* const uri : {"",
                                "?v=7",
                                "#x",
                                " a.glb",
                                "a.glb ",
                                "a\tb.glb",
                                "a.glb\n",
                                "a%00.glb",
                                "a%0a.glb",
                                "a\\b.glb",
                                "a%5Cb.glb",
                                "a%2Fb.glb",
                                "a%2fb.glb",
                                "/a.glb",
                                "//host/a.glb",
                                "http://host/a.glb",
                                "http:a.glb",
                                "C:/a.glb",
                                "file:a.glb",
                                "data:,a",
                                "a%.glb",
                                "a%4",
                                "a%zz.glb",
                                "a\x7F.glb",
                                ".",
                                "y/..",
                                "y/"}) {
    CAPTURE(uri);
    const UriFile file = file_of_uri(uri, "in");
    CHECK(file.path.empty());
    CHECK_FALSE(file.fault.empty());
  }
}
