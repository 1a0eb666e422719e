#include <nlohmann/json.hpp>

#include "lib/check/verdict_text.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("the text of a proxy that holds says so last", "[quick][check]") {
  const std::string text = verdict_text(check(cube(2), triangles_of(cube(1))), "p.ply");
  CHECK(text.find("proxy p.ply: 12 triangles, 8 vertices, 1 component, genus 0\n") == 0);
  CHECK(text.find("strictly encloses the scene yes") != std::string::npos);
  CHECK(text.find("NO") == std::string::npos);
  CHECK(text.size() > 6);
  CHECK(text.substr(text.size() - 6) == "holds\n");
}

TEST_CASE("the text of a failure names what, how often and where", "[quick][check]") {
  const CheckReport r = check(cube(1), triangles_of(cube(0.5, {4, 0, 0})));
  const std::string text = verdict_text(r, "p.ply");
  CHECK(text.find("strictly encloses the scene NO") != std::string::npos);
  CHECK(text.find("12 scene triangles lie outside the proxy") != std::string::npos);
  CHECK(text.find("scene triangle 0 at (") != std::string::npos);
  CHECK(text.find("\ndoes not hold: 12 scene triangles lie outside the proxy\n") != std::string::npos);
  IndexedMesh open = cube(1);
  open.triangles.pop_back();
  CHECK(failures(check(open)) == "3 edges have one triangle only: holes");
  CHECK(failures(check(IndexedMesh{})) == "the proxy is empty");
  CHECK(failures(check(cube(1))).empty());
}

TEST_CASE("the text says that inner parts count in the distance of the scene", "[quick][check]") {
  const IndexedMesh scene = join(cube(1), cube(0.5));
  const std::string text = verdict_text(check(cube(2), triangles_of(scene)), "p");
  CHECK(text.find("sampled points; inner parts of the scene count\n  distance proxy to scene") != std::string::npos);
  CHECK(text.find("sampled points\nholds") != std::string::npos);
}

TEST_CASE("the text says why a proxy around a scene may have less volume", "[quick][check]") {
  const auto text_of = [](const IndexedMesh& scene) {
    return verdict_text(check(cube(1.1), triangles_of(scene)), "p");
  };
  const IndexedMesh twice = join(cube(1), cube(1));  // 16, in a box of 10.648
  CHECK(text_of(twice).find("(ratio 0.6655: the scene's parts overlap and count twice)") != std::string::npos);
  CHECK(text_of(cube(1)).find("(ratio 1.331)") != std::string::npos);
}

TEST_CASE("the JSON holds each answer, each finding and null for what was not measured", "[quick][check]") {
  const auto alone = nlohmann::json::parse(verdict_json(check(cube(1)), "p.ply"));
  CHECK(alone["holds"] == true);
  CHECK(alone["answer"] == "proven");
  CHECK(alone["why"].is_null());
  CHECK(alone["scene"].is_null());
  CHECK(alone["verdict"]["encloses"].is_null());
  CHECK(alone["proxy"]["genus"] == 0);
  CHECK(alone["findings"].size() == 21);
  const auto both =
      nlohmann::json::parse(verdict_json(check(cube(1), triangles_of(cube(0.5, {4, 0, 0}))), "bad \xff name"));
  CHECK(both["holds"] == false);
  CHECK(both["answer"] == "refuted");
  CHECK(both["answers"]["encloses"] == "refuted");
  CHECK(both["verdict"]["closed"] == true);
  CHECK(both["verdict"]["encloses"] == false);
  CHECK(both["findings"]["outside"]["count"] == 12);
  CHECK(both["findings"]["outside"]["examples"].size() == 5);
  CHECK(both["findings"]["outside"]["examples"][0]["scene_triangle"] == 0);
  CHECK(both["measures"]["volume"] == 8);
  for (const char* way : {"scene_to_proxy", "proxy_to_scene"}) {
    CHECK(both["measures"][way]["at_most"].is_number());
    CHECK(both["measures"][way]["sampled"] == false);
  }
  CheckReport large = check(cube(1), triangles_of(cube(0.5)));
  large.scene_to_proxy->at_most.reset();  // as of a large scene
  CHECK(nlohmann::json::parse(verdict_json(large, ""))["measures"]["scene_to_proxy"]["sampled"] == true);
  CHECK(nlohmann::json::parse(verdict_json(check(IndexedMesh{}), ""))["proxy"]["genus"].is_null());
}
