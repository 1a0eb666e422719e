#include <optional>

#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/points/scene_points.h"
#include "io/scene/points/text_copy.h"

// Wavefront OBJ: the three numbers of each line "v". Lines "vn" belong to no vertex, and stay.

namespace bp {

namespace {

class ObjPoints final : public ScenePoints {
 public:
  explicit ObjPoints(SceneFilePtr file) : file_(std::move(file)), text_(file_) {}

  bool read(std::vector<Vec3d>& out) override {
    next(text_);
    out = std::move(batch_.positions);
    taken_ += out.size();
    return !out.empty();
  }
  [[nodiscard]] std::uint64_t count() const override {
    return text_.offset() == 0 ? 0 : std::uint64_t(double(taken_) * double(file_->size()) / double(text_.offset()));
  }
  void write(const MovePoints& move, OutputFile& out) override {
    TextScanner text(file_);
    TextCopy copy(file_, out);
    for (next(text); !batch_.positions.empty(); next(text)) {
      move(batch_);
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const double value = batch_.positions[i / 3][i % 3];
        copy.replace(places_[i], value, places_[i].end - places_[i].begin <= kShort);
      }
    }
    copy.finish();
  }
  [[nodiscard]] std::string left_behind() const override {
    return has_normals_ ? "its normals (vn) are those of the rest pose; let the program that reads it compute them"
                        : "";
  }

 private:
  static constexpr std::uint64_t kShort = 7;  // characters of a number: shorter ones have the precision of a float

  void next(TextScanner& text);
  SceneFilePtr file_;
  TextScanner text_;
  PointBatch batch_;
  std::vector<NumberPlace> places_;  // three for each vertex of the batch
  std::uint64_t taken_ = 0;
  bool has_normals_ = false;
};

void ObjPoints::next(TextScanner& text) {
  batch_.positions.clear();
  places_.clear();
  for (; !text.at_end() && batch_.positions.size() < kBatch; text.next_line()) {
    if (!text.word_on_line() || text.peek() != 'v') continue;
    const std::string_view word = text.word();
    has_normals_ = has_normals_ || word == "vn";
    if (word != "v") continue;
    Vec3d p;
    for (double& c : p) {
      NumberPlace place;
      const bool there = text.word_on_line();
      place.begin = text.offset();
      if (!there || !text.real(c)) text.fail_here("a vertex needs three numbers; is the file damaged?");
      place.end = text.offset();
      place.value = c;
      places_.push_back(place);
    }
    batch_.positions.push_back(p);
  }
}

}  // namespace

std::unique_ptr<ScenePoints> obj_points(SceneFilePtr file) {
  return std::make_unique<ObjPoints>(std::move(file));
}

}  // namespace bp
