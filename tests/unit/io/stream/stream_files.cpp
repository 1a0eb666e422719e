#include "tests/unit/io/stream/stream_files.h"

#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include "lib/core/error.h"

namespace stream_files {

using namespace bp;

TempFile::TempFile(const Bytes& bytes) : fd_(::memfd_create("bp-test", 0)) {
  if (fd_ < 0) throw std::runtime_error("no memory file");
  path_ = fmt::format("/proc/self/fd/{}", fd_);
  assign(bytes);
}
TempFile::~TempFile() {
  ::close(fd_);
}
void TempFile::assign(const Bytes& bytes) {
  const auto n = std::int64_t(bytes.size());
  if (::ftruncate(fd_, 0) != 0 || ::pwrite(fd_, bytes.data(), bytes.size(), 0) != n)
    throw std::runtime_error("cannot write a memory file");
}
Bytes TempFile::bytes() const {
  struct stat info {};
  if (::fstat(fd_, &info) != 0) throw std::runtime_error("no memory file");
  Bytes bytes(std::size_t(info.st_size));
  if (::pread(fd_, bytes.data(), bytes.size(), 0) != info.st_size) throw std::runtime_error("cannot read back");
  return bytes;
}

StreamFolder::StreamFolder() : path_(std::filesystem::temp_directory_path().string() + "/bp-test-XXXXXX") {
  if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = path_;
  path_ += "/out";
}
StreamFolder::~StreamFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}
Bytes StreamFolder::bytes() const {
  std::ifstream in(path_, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void fit_bounds(StreamHeader& h) {
  h.bounds = {};
  const VoxelBox voxels = voxels_of(h.bricks);
  for (const VoxelCoord& v : {voxels.min, voxels.max})
    h.bounds.add(h.frame.world({std::int64_t(v.x) * 64, std::int64_t(v.y) * 64, std::int64_t(v.z) * 64}));
}

StreamHeader random_header(std::uint32_t seed) {
  std::mt19937 random(seed);
  StreamHeader h;
  h.frame.voxel = round_up_to_bits(std::uniform_real_distribution<double>(0.001, 1000)(random), 8);
  for (auto& o : h.frame.origin) o = std::int64_t(random()) * 16 - (std::int64_t(1) << 35);
  h.frame.up = UpAxis(random() % 6);
  for (int i = 0; i < 3; ++i) {
    h.bricks.min[i] = int(random() % 9) - 6;
    h.bricks.max[i] = h.bricks.min[i] + 1 + int(random() % 5);
  }
  if (random() % 4 != 0) fit_bounds(h);
  h.slab_axis = longest_axis(h.bricks);
  h.fill = FillMode(random() % 4);
  h.has_closing = random() % 3 != 0;
  if (h.has_closing) {
    h.element = StructuringElement(random() % 2);
    h.scale.base = 2 * h.frame.voxel;
    h.scale.rules = {box_rule({0, 0, 0}, {1, 1, 1}, 0.5 * h.frame.voxel),
                     stroke_rule(ScaleMode::decrease, {1, 2, 3}, 4, h.frame.voxel, h.scale.base)};
  }
  for (std::uint32_t i = 0; i < random() % 3; ++i)
    h.provenance.push_back({"bpvox", "0.1.0", "--voxel 0.1 --name \"\xc3\xa9\"", "00ff"});
  if (random() % 2) {
    h.scene = {{{"a.ply", 3}, {"b/\xc3\xa9.obj", std::uint64_t(1) << 40}}, "stl", 12, std::string(32, '7')};
    h.scene.files.resize(1 + random() % 2);
  }
  return h;
}

std::vector<Brick> random_bricks(const StreamHeader& header, std::uint32_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Brick> bricks;
  for (int n = 0; n < count; ++n) {
    Brick b;
    for (int i = 0; i < 3; ++i)
      b.coord[i] = header.bricks.min[i] + int(random() % std::uint64_t(header.bricks.size()[i]));
    b.layer = header.has_closing && random() % 2 ? Layer::closing : Layer::solid;
    switch (random() % 4) {
      case 0:
        b.bits.fill(~std::uint64_t(0));
        break;
      case 1:
        for (std::uint64_t& w : b.bits) w = random() & random();
        break;
      case 2:
        for (std::size_t i = 0; i < kBrickWords; ++i) b.bits[i] = i / 64 < 9 + random() % 4 ? 0xffff00 : 0;
        break;
      default:
        b.bits[random() % kBrickWords] = std::uint64_t(1) << random() % 64;
    }
    b.fill = classify(b.bits);
    bricks.push_back(b);
  }
  const auto less = [&](const Brick& a, const Brick& b) { return slab_order(header.slab_axis, a, b); };
  std::stable_sort(bricks.begin(), bricks.end(), less);
  bricks.erase(std::unique(bricks.begin(), bricks.end(), [&](const Brick& a, const Brick& b) { return !less(a, b); }),
               bricks.end());
  return bricks;
}

StreamHeader small_header() {
  StreamHeader h;
  h.frame = {0.5, {-3, 0, 7}, UpAxis::y};
  h.bounds.add({0, 0, 4});
  h.bounds.add({1, 1, 5});
  h.bricks = {{0, 0, 0}, {1, 1, 1}};
  h.provenance = {{"bpvox", "0.1.0", "--voxel 0.5", ""}};
  return h;
}

std::vector<Brick> small_bricks() {
  Brick b;
  b.bits[1 * 64 + 2] = std::uint64_t(1) << 9;
  b.fill = BrickFill::mixed;
  return {b};
}

Bytes written(const StreamHeader& header, const std::vector<Brick>& bricks, int level) {
  StreamFolder file;
  OutputFile out(file.path(), false);
  BrickWriter writer(out, header, level);
  for (const Brick& b : bricks) writer.write(b);
  writer.finish();
  out.commit();
  Bytes bytes = file.bytes();
  if (writer.totals().bytes != bytes.size()) throw std::logic_error("the writer counts other bytes than it writes");
  return bytes;
}

Content read_back(const Bytes& bytes) {
  static TempFile file;
  file.assign(bytes);
  BrickReader reader(file.path());
  Content content;
  content.header = reader.header();
  Brick b;
  while (reader.read(b)) content.bricks.push_back(b);
  if (reader.read(b)) throw std::logic_error("a brick after the end");
  content.totals = reader.totals();
  return content;
}

std::string error_of(const Bytes& bytes) {
  try {
    (void)read_back(bytes);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw std::logic_error(std::string("not bad_input: ") + e.what());
    return e.what();
  }
  return "";
}

bool same(const Brick& a, const Brick& b) {
  return a.coord == b.coord && a.layer == b.layer && a.fill == b.fill && a.bits == b.bits;
}
bool same(const std::vector<Brick>& a, const std::vector<Brick>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](auto& x, auto& y) { return same(x, y); });
}

}  // namespace stream_files
