#include <cmath>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/image/canvas.h"
#include "lib/image/render.h"
#include "tests/catch.h"
#include "tests/support/textured_scene.h"
#include "tests/unit/check/meshes.h"
#include "tests/unit/image/block_typeface.h"

using namespace bp;
using namespace bp::test;

namespace {

const Color kBlank{255, 255, 255};

Image picture(const std::vector<View>& views, RenderOptions options = {}) {
  options.panel_width = options.panel_height = 64;
  return render(views, options);
}

std::size_t count_other(const Image& image, Color background) {
  return std::size_t(std::count_if(image.pixels.begin(), image.pixels.end(), [&](Color c) { return c != background; }));
}

View view_of(const IndexedMesh& m) {
  View v;
  v.mesh = &m;
  return v;
}

}  // namespace

TEST_CASE("triangles that share an edge leave no gap and cover no sample twice", "[quick][image]") {
  // A fan around an odd point fills a square; each triangle alone is drawn on a canvas of its own and counted.
  const Vec3d corners[4] = {{3.3, 2.7, 0}, {28.5, 4.5, 0}, {27.1, 29.9, 0}, {4.5, 28.5, 0}}, hub{15.5, 16.5, 0};
  std::vector<TriangleD> fan;
  for (std::size_t i = 0; i < 4; ++i) fan.push_back({hub, corners[i], corners[(i + 1) % 4]});
  const auto covered = [](std::span<const TriangleD> t) {
    Canvas canvas(32, 32, {0, 0, 0});
    canvas.draw(t, {255, 255, 255});
    Image image(16, 16, {});
    canvas.resolve(image, 0, 0);
    double sum = 0;
    for (const Color c : image.pixels) sum += c.r;
    return std::lround(sum);
  };
  const std::vector<TriangleD> square = {{corners[0], corners[1], corners[2]}, {corners[0], corners[2], corners[3]}};
  long one_by_one = 0;
  for (const TriangleD& t : fan) one_by_one += covered(std::span(&t, 1));
  CHECK(covered(fan) == covered(square));
  CHECK(std::abs(one_by_one - covered(fan)) <= 64);  // rounding of means along the inner edges
}

TEST_CASE("each sample of a grid of triangles belongs to exactly one of them", "[quick][image]") {
  // 5 x 5 samples between integer corners, every corner and diagonal through sample centres.
  std::vector<TriangleD> grid;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Vec3d a{x + 0.5, y + 0.5, 0}, b{x + 1.5, y + 0.5, 0}, c{x + 1.5, y + 1.5, 0}, d{x + 0.5, y + 1.5, 0};
      grid.push_back({a, b, c});
      grid.push_back({a, c, d});
    }
  int total = 0;
  for (const TriangleD& t : grid) {
    Canvas canvas(20, 20, {0, 0, 0});
    canvas.draw(std::span(&t, 1), {4, 4, 4});  // below 4/4 after the mean only if nothing is drawn
    Image image(10, 10, {});
    canvas.resolve(image, 0, 0);
    for (const Color c : image.pixels) total += c.r;
  }
  CHECK(total == 64);  // 8 x 8 samples in a half-open square, each worth 1
}

TEST_CASE("the nearer triangle wins in whichever order they come", "[quick][image]") {
  const TriangleD near{{{0, 0, 1}, {20, 0, 1}, {0, 20, 1}}}, far{{{0, 0, 2}, {20, 0, 2}, {0, 20, 2}}};
  const auto draw = [](const TriangleD& a, Color ca, const TriangleD& b, Color cb) {
    Canvas canvas(8, 8, {0, 0, 0});
    canvas.draw(std::span(&a, 1), ca);
    canvas.draw(std::span(&b, 1), cb);
    Image image(4, 4, {});
    canvas.resolve(image, 0, 0);
    return image.at(1, 1);
  };
  const Color c = draw(near, {200, 0, 0}, far, {0, 200, 0});
  CHECK(c.r > 50);
  CHECK(c.g == 0);
  CHECK(draw(far, {0, 200, 0}, near, {200, 0, 0}) == c);
}

TEST_CASE("a triangle with colours shows them at its corners and light between them", "[quick][image]") {
  const TriangleD t{{{0, 0, 1}, {200, 0, 1}, {0, 200, 1}}};
  const LinearColor red{65535, 0, 0}, blue{0, 0, 65535};
  Canvas canvas(200, 200, {0, 0, 0});
  const TriangleColors colors{red, blue, red};
  canvas.draw(std::span(&t, 1), std::span(&colors, 1));
  Image image(100, 100, {});
  canvas.resolve(image, 0, 0);
  CHECK(image.at(1, 1).r > 150);
  CHECK(image.at(1, 1).b < 40);
  CHECK(image.at(95, 1).b > 150);
  CHECK(image.at(1, 95).r > 150);
  CHECK(image.at(1, 95).b < 40);
  CHECK(std::abs(int(image.at(49, 1).r) - int(image.at(49, 1).b)) <= 3);  // half of each: 188 of 255, shaded
  CHECK(double(image.at(49, 1).r) / image.at(1, 1).r == Approx(188.0 / 255).margin(0.03));
  CHECK(image.at(49, 1).g == 0);

  Canvas one(8, 8, {0, 0, 0}), same(8, 8, {0, 0, 0});
  const TriangleColors all_red{red, red, red};
  one.draw(std::span(&t, 1), Color{255, 0, 0});
  same.draw(std::span(&t, 1), std::span(&all_red, 1));
  Image a(4, 4, {}), b(4, 4, {});
  one.resolve(a, 0, 0);
  same.resolve(b, 0, 0);
  CHECK(a.pixels == b.pixels);
}

TEST_CASE("lines behind a face do not show, lines on it and before it do", "[quick][image]") {
  const std::vector<TriangleD> face = {{{{2, 2, 10}, {30, 2, 10}, {2, 30, 30}}}};
  const auto dark_samples = [&](double depth_offset) {
    Canvas canvas(32, 32, {255, 255, 255});
    canvas.draw(face, {255, 255, 255});
    const double z = 10 + 20.0 * (8 - 2) / 28;  // of the face at y = 8
    const std::array<Vec3d, 2> line{Vec3d{4, 8, z + depth_offset}, Vec3d{20, 8, z + depth_offset}};
    canvas.draw_lines(std::span(&line, 1), {0, 0, 0}, 0.9);
    Image image(16, 16, {});
    canvas.resolve(image, 0, 0);
    return std::count_if(image.pixels.begin(), image.pixels.end(), [](Color c) { return c.r < 100; });
  };
  CHECK(dark_samples(0) >= 7);
  CHECK(dark_samples(-5) >= 7);
  CHECK(dark_samples(5) == 0);
}

TEST_CASE("edges within a face are not drawn", "[quick][image]") {
  IndexedMesh quad;
  quad.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<TriangleD> triangles{{quad.vertices[0], quad.vertices[1], quad.vertices[2]},
                                         {quad.vertices[0], quad.vertices[2], quad.vertices[3]}};
  RenderOptions front;
  front.azimuth = front.elevation = 0;
  const auto dark_at = [&](const View& v, int x, int y) { return picture({v}, front).at(x, y).r < 130; };
  const std::vector<std::uint8_t> inner{4, 1};
  View spans;
  spans.triangles = triangles, spans.edges = true;
  CHECK(dark_at(spans, 32, 31));  // the diagonal
  spans.inner_edges = inner;
  CHECK_FALSE(dark_at(spans, 32, 31));
  CHECK(dark_at(spans, 32, 61));
  CHECK(dark_at(spans, 2, 32));
  quad.inner_edges = inner;
  View mesh = view_of(quad);
  mesh.edges = true;
  CHECK(picture({mesh}, front).pixels == picture({spans}, front).pixels);
}

TEST_CASE("the picture does not depend on threads or on how triangles arrive", "[quick][image]") {
  const IndexedMesh m = sphere(5, 3, {6e6, 0, -6e6});
  std::vector<TriangleD> list = triangles_of(m);
  VectorSource source(list, 100);
  View meshes = view_of(m), spans, streamed;
  meshes.edges = true;
  spans.triangles = list;
  spans.edges = true;
  const auto drawn = [&](int threads, const View& v) {
    const ThreadLimit limit(threads);
    return picture({v}).pixels;
  };
  const auto expected = drawn(1, meshes);
  CHECK(count_other(picture({meshes}), kBlank) > 1000);
  CHECK(drawn(2, meshes) == expected);
  CHECK(drawn(2, spans) == expected);
  streamed.source = &source;
  spans.edges = false;
  CHECK(picture({streamed}).pixels == picture({spans}).pixels);
  RenderOptions part;
  part.bounds.add({6e6 - 1, -1, -6e6 - 1});
  part.bounds.add({6e6 + 1, 1, -6e6 + 1});
  CHECK(picture({streamed}, part).pixels == picture({spans}, part).pixels);
  CHECK(picture({streamed}, part).pixels != picture({streamed}).pixels);
}

TEST_CASE("azimuth, elevation and up axis choose what is seen", "[quick][image]") {
  // A box with a long x, middle y, short z, seen from the front of a z-up scene: as wide as x, as high as z.
  const IndexedMesh m = box({0, 0, 0}, {4, 2, 1});
  const auto extent = [&](double azimuth, double elevation, UpAxis up) {
    RenderOptions options;
    options.azimuth = azimuth, options.elevation = elevation, options.up = up;
    const Image image = picture({view_of(m)}, options);
    int x0 = 99, x1 = -1, y0 = 99, y1 = -1;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (image.at(x, y) != kBlank)
          x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    return double(x1 - x0 + 1) / (y1 - y0 + 1);
  };
  CHECK(std::abs(extent(0, 0, UpAxis::z) - 4) < 0.4);
  CHECK(std::abs(extent(90, 0, UpAxis::z) - 2) < 0.2);
  CHECK(std::abs(extent(0, 90, UpAxis::z) - 2) < 0.2);
  CHECK(std::abs(extent(0, 0, UpAxis::y) - 2) < 0.2);
  CHECK(std::abs(extent(90, 0, UpAxis::y) - 0.5) < 0.1);
}

TEST_CASE("what cannot be drawn leaves an empty panel and no crash", "[quick][image]") {
  IndexedMesh m = cube(1);
  for (Vec3d& p : m.vertices) p[1] = std::nan("");
  m.triangles.push_back({0, 1, 99});
  View v = view_of(m);
  v.edges = true;
  CHECK(count_other(picture({v}), kBlank) == 0);
  CHECK(count_other(picture({View{}}), kBlank) == 0);
  CHECK(render({}).width == 720);
  m = cube(1);
  m.vertices[7] = {HUGE_VAL, 1e300, -1e300};
  CHECK(picture({view_of(m)}).width == 64);
  m.vertices[7] = m.vertices[6];
  for (Vec3d& p : m.vertices) p = {3, 3, 3};  // no extent
  CHECK(count_other(picture({view_of(m)}), kBlank) == 0);
  RenderOptions tiny;
  tiny.panel_width = 3;
  CHECK_THROWS_AS(render({}, tiny), Error);
}

TEST_CASE("panels stand side by side at one scale, labels below", "[quick][image]") {
  const IndexedMesh large = sphere(3, 2), small = sphere(3, 1);
  View a = view_of(large), b = view_of(small);
  a.label = "a";
  b.label = "two\nlines";
  RenderOptions options;
  BlockTypeface typeface;
  options.typeface = &typeface;
  const Image image = picture({a, b}, options);
  CHECK(image.width == 128);
  CHECK(image.height > 64 + 2 * 9);
  CHECK(typeface.lines == std::vector<std::string>{"a", "two", "lines"});
  CHECK(picture({a, b}).height == 64);  // without a typeface
  std::size_t left = 0, right = 0, text = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == kBlank) continue;
      ++(y >= 64 ? text : x < 64 ? left : right);
    }
  CHECK(std::abs(double(left) / double(right) - 4) < 0.4);
  CHECK(text > 50);
}

TEST_CASE("a panel with bounds of its own is drawn as if alone", "[quick][image]") {
  const IndexedMesh near = sphere(2, 1), far = sphere(2, 4, {4096, 0, 0});
  RenderOptions around_near;
  View one = view_of(far), other = view_of(near);
  for (const Vec3d& p : near.vertices) around_near.bounds.add(p);
  for (const Vec3d& p : far.vertices) one.bounds.add(p);
  const Image alone = picture({other}, around_near);
  other.bounds = around_near.bounds;
  const Image image = picture({one, other});
  REQUIRE(image.width == 2 * alone.width);
  bool same = true, something = false;
  for (int y = 0; y < alone.height; ++y) {
    for (int x = 0; x < alone.width; ++x) {
      same = same && image.at(x + alone.width, y) == alone.at(x, y);
      something = something || image.at(x, y) != kBlank;
    }
  }
  CHECK(same);
  CHECK(something);
}

TEST_CASE("zoom enlarges about the middle or the point looked at", "[quick][image]") {
  const IndexedMesh m = sphere(4, 2, {6e6, -4e6, 12});
  const auto area = [&](double zoom) {
    RenderOptions options;
    options.zoom = zoom;
    return double(count_other(picture({view_of(m)}, options), kBlank));
  };
  const double whole = area(1);
  CHECK(area(0.5) / whole == Approx(0.25).margin(0.02));
  CHECK(area(10) == 64 * 64);  // the middle of a ball has ball all around
  CHECK(area(1e6) == 64 * 64);

  // A corner of a box, large: a quarter of the picture from the front, and the same from near and far.
  RenderOptions corner;
  corner.azimuth = corner.elevation = 0;
  corner.look_at = Vec3d{6e6, 0, 0};
  const IndexedMesh b = box({6e6, 0, 0}, {6e6 + 4, 4, 1});
  for (const double zoom : {3.0, 700.0, 1e5, 1e6}) {
    corner.zoom = zoom;
    const Image image = picture({view_of(b)}, corner);
    CAPTURE(zoom);
    CHECK(std::abs(double(count_other(image, kBlank)) - 32 * 32) <= 40);
    CHECK(image.at(40, 20) != kBlank);
    CHECK(image.at(20, 40) == kBlank);
    VectorSource source(triangles_of(b), 3);  // drawn in parts
    View streamed;
    streamed.source = &source;
    CHECK(picture({streamed}, corner).pixels == image.pixels);
  }
  View edges = view_of(b);
  edges.edges = true;
  const Image image = picture({edges}, corner);
  CHECK(image.at(40, 31).r < 130);  // the lower edge
  CHECK(image.at(32, 20).r < 130);  // the left edge
}

TEST_CASE("images lie on triangles where their places say, also on ones cut off far away, and holes show",
          "[quick][image]") {
  auto textures = std::make_shared<MemoryTextures>();
  TextureImage four(2, 2);
  four.texels = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {0, 0, 0, 0}};
  textures->images.push_back(four);
  textures->materials.push_back({0, {TextureWrap::clamp, TextureWrap::clamp}, AlphaMode::mask});
  ImageCache images(textures, {});
  for (const double far : {0.0, 1e7}) {
    // The square of 64 samples, and so much of its plane around it.
    const double lo = -far, hi = 64 + far;
    const auto uv = [](double x) { return float(x / 64); };
    const std::vector<TriangleD> square{{Vec3d{lo, lo, 1}, {hi, lo, 1}, {hi, hi, 1}},
                                        {Vec3d{lo, lo, 1}, {hi, hi, 1}, {lo, hi, 1}}};
    std::vector<TriangleTexture> laid;
    for (const TriangleD& t : square) {
      laid.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) laid.back().uv[k] = {uv(t[k][0]), uv(t[k][1])};
      laid.back().material = 0;
    }
    const std::vector<TriangleColors> white(2);
    Canvas canvas(64, 64, {9, 9, 9});
    canvas.draw(square, white, {}, laid, &images);
    Image image(32, 32, {});
    canvas.resolve(image, 0, 0);
    const auto only = [](std::uint8_t a, std::uint8_t b, std::uint8_t c) { return a > 150 && b == 0 && c == 0; };
    CAPTURE(far);
    CHECK(only(image.at(4, 4).r, image.at(4, 4).g, image.at(4, 4).b));
    CHECK(only(image.at(28, 4).g, image.at(28, 4).r, image.at(28, 4).b));
    CHECK(only(image.at(4, 28).b, image.at(4, 28).r, image.at(4, 28).g));
    CHECK(image.at(28, 28) == Color{9, 9, 9});
  }
}

TEST_CASE("the point behind a pixel is the one that the picture shows there", "[quick][image]") {
  const Vec3d centre{6e6, -4e6, 12};
  const IndexedMesh ball = sphere(5, 2, centre), block = box({6e6 - 9, -4e6, 12}, {6e6 - 5, -4e6 + 3, 14});
  const std::vector<View> views{view_of(ball), view_of(block)};
  RenderOptions options;
  options.panel_width = options.panel_height = 64;
  options.up = GENERATE(UpAxis::y, UpAxis::z, UpAxis::minus_x);
  options.azimuth = 50, options.elevation = -10;
  options.zoom = GENERATE(1.0, 3.0);
  const Image image = render(views, options);
  int found = 0, beside = 0;
  for (int y = 0; y < 64; y += 3) {
    for (int x = 0; x < 128; x += 3) {
      const std::optional<Vec3d> p = point_behind(views, options, x, y);
      CHECK(p.has_value() == (image.at(x, y) != kBlank));
      if (!p) continue;
      ++found;
      // A picture around that point shows it in the middle, and nothing lies before it.
      RenderOptions near = options;
      near.look_at = p;
      near.zoom = 100;
      const std::optional<Vec3d> again = point_behind(views, near, x < 64 ? 32 : 96, 32);
      if (!again) {  // beside the outline
        ++beside;
        continue;
      }
      if (length(*again - *p) > 0.1) FAIL_CHECK("pixel " << x << " " << y << ": " << length(*again - *p));
      if (x < 64 && std::abs(length(*p - centre) - 2) > 0.02) FAIL_CHECK("not on the ball");
    }
  }
  CHECK(found > 50);
  CHECK(beside * 50 < found);
  CHECK_THROWS_AS(point_behind(views, options, 128, 0), Error);
  CHECK_THROWS_AS(point_behind(views, options, 0, -1), Error);
}
