#include "tests/catch.h"
#include "tools/cli/shell_word.h"

namespace bp::test {

TEST_CASE("a name in a command to copy is one word, and no option", "[quick][tools]") {
  CHECK(shell_word("out/b_LOD0.glb") == "out/b_LOD0.glb");
  CHECK(shell_word("b c.obj") == "'b c.obj'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("größe.obj") == "größe.obj");
  CHECK(shell_word("-dash.obj") == "./-dash.obj");
  CHECK(shell_word("-d ash") == "'./-d ash'");
  CHECK(shell_word("-") == "-");
  CHECK(shell_word("") == "''");
}

}  // namespace bp::test
