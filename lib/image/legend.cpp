#include "lib/image/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/image/canvas.h"

namespace bp {

namespace {

constexpr int kLeastWidth = 160;  // pixels of a panel with axes and ruler
constexpr int kLeastSize = 9;     // pixels of text that can be read
constexpr double kRulerShare = 0.25;
constexpr Color kAxisColors[] = {{214, 40, 40}, {30, 140, 40}, {40, 80, 220}};
constexpr const char* kAxisNames[] = {"x", "y", "z"};

void fill(Image& image, int x0, int y0, int x1, int y1, Color color) {
  for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y)
    for (int x = std::max(0, x0); x < std::min(image.width, x1); ++x) image.at(x, y) = color;
}

int lines_height(std::size_t lines, int size) {
  return int(lines) * size * 7 / 5;
}

/// Returns the text without its first character.
std::string_view shortened(std::string_view text) {
  std::size_t n = 1;
  while (n < text.size() && (static_cast<unsigned char>(text[n]) & 0xC0) == 0x80) ++n;  // UTF-8
  return text.substr(n);
}

}  // namespace

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {10.0, 5.0, 2.0}) {
    if (step * power <= most * (1 + 1e-12)) return step * power;
  }
  return power;
}

Legend::Legend(int panel_width, Typeface* typeface, bool marks, Color ink, Color paper)
    : width_(panel_width),
      typeface_(typeface),
      marks_(marks && panel_width >= kLeastWidth),
      size_(std::clamp(panel_width / 48, kLeastSize, 32)),
      ink_(ink),
      paper_(paper) {}

int Legend::axes_side() const {
  return marks_ ? 5 * size_ : 0;
}

int Legend::height(std::size_t lines) const {
  const int text = typeface_ != nullptr && lines > 0 ? lines_height(lines, size_) + size_ / 2 : 0;
  return std::max(text, axes_side());
}

void Legend::draw_axes(Image& image, int x, int y, const std::array<Vec3d, 3>& directions) const {
  if (!marks_) return;
  const int side = axes_side();
  const double centre = side, reach = 0.66 * side;  // in samples, two to a pixel
  Canvas canvas(2 * side, 2 * side, paper_);
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return directions[a][2] > directions[b][2];
  });  // the farthest first
  for (const std::size_t i : order) {
    const Vec3d end{centre + reach * directions[i][0], centre + reach * directions[i][1], 0};
    const std::array<Vec3d, 2> line{Vec3d{centre, centre, 0}, end};
    canvas.draw_lines(std::span(&line, 1), kAxisColors[i], 2);
  }
  canvas.resolve(image, x, y);
  for (const std::size_t i : order) {
    if (typeface_ == nullptr) break;
    const double beyond = reach / 2 + 0.5 * size_;
    const int cx = x + int(std::lround(side / 2.0 + beyond * directions[i][0]));
    const int cy = y + int(std::lround(side / 2.0 + beyond * directions[i][1]));
    typeface_->draw(image, cx - typeface_->width(kAxisNames[i], size_) / 2, cy + size_ / 4, kAxisNames[i], size_,
                    kAxisColors[i]);
  }
}

void Legend::draw_ruler(Image& image, int right, int bottom, double pixels_per_unit) const {
  const double most = kRulerShare * width_ / pixels_per_unit;
  if (!marks_ || !(most > 0) || !std::isfinite(most)) return;
  const double units = round_length(most);
  const int bar = int(std::lround(units * pixels_per_unit)), tick = std::max(2, size_ / 3);
  const int x1 = right - size_, x0 = x1 - bar, y = bottom - size_ / 2 - tick;
  const std::string text = fmt::format("{:g} unit{}", units, units == 1 ? "" : "s");
  const int text_width = typeface_ != nullptr ? typeface_->width(text, size_) : 0;
  fill(image, x0 - text_width - size_, y - size_, right, bottom, paper_);  // a model may reach into the corner
  fill(image, x0, y - 1, x1, y + 1, ink_);
  fill(image, x0, y - tick, x0 + 2, y + tick, ink_);
  fill(image, x1 - 2, y - tick, x1, y + tick, ink_);
  if (typeface_ != nullptr) typeface_->draw(image, x0 - text_width - size_ / 2, y + size_ / 3, text, size_, ink_);
}

void Legend::draw_bar(Image& image, int x, int bottom, const ColorBar& bar) const {
  if (!marks_ || bar.low.empty()) return;
  const auto text_width = [&](const std::string& text) {
    return typeface_ != nullptr ? typeface_->width(text, size_) : 0;
  };
  const int length = int(std::lround(kRulerShare * width_)), gap = size_ / 2;
  const int x0 = x + size_ + text_width(bar.low) + gap, x1 = x0 + length, top = bottom - 2 * size_;
  fill(image, x, top - gap, x1 + gap + text_width(bar.high) + gap, bottom, paper_);
  for (int i = 0; i < length; ++i)
    fill(image, x0 + i, top, x0 + i + 1, top + size_, color_on_bar(double(i) / std::max(1, length - 1)));
  if (typeface_ == nullptr) return;
  typeface_->draw(image, x + size_, top + size_ * 9 / 10, bar.low, size_, ink_);
  typeface_->draw(image, x1 + gap, top + size_ * 9 / 10, bar.high, size_, ink_);
}

bool Legend::fits(const std::string& text) const {
  return typeface_->width(text, size_) <= width_ - axes_side() - size_;
}

/// Returns the word, or as much of its end as the panel holds.
std::string Legend::end_of(std::string_view word) const {
  std::string shown(word);
  while (!word.empty() && !fits(shown)) {
    word = shortened(word);
    shown = "..." + std::string(word);
  }
  return shown;
}

std::vector<std::string> Legend::lines(std::string_view label) const {
  std::vector<std::string> all;
  if (typeface_ == nullptr || label.empty()) return all;
  bool new_line = true;
  while (!label.empty()) {
    const std::size_t end = std::min(label.find_first_of(" \n"), label.size());
    const std::string word(label.substr(0, end));
    if (!new_line && fits(all.back() + " " + word)) {
      all.back() += " " + word;
    } else {
      all.push_back(end_of(word));
    }
    new_line = end < label.size() && label[end] == '\n';
    label.remove_prefix(std::min(end + 1, label.size()));
  }
  return all;
}

void Legend::write(Image& image, int x, int y, const std::vector<std::string>& lines) const {
  for (const std::string& line : lines) {
    y += lines_height(1, size_);
    typeface_->draw(image, x + axes_side() + size_ / 2, y, line, size_, ink_);
  }
}

}  // namespace bp
