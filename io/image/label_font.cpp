#include "io/image/label_font.h"

#include <ft2build.h>

#include <algorithm>
#include <vector>
#include FT_FREETYPE_H

namespace bp {

namespace {

struct LibraryCloser {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct FaceCloser {
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};
using LibraryPtr = std::unique_ptr<FT_LibraryRec_, LibraryCloser>;
using FacePtr = std::unique_ptr<FT_FaceRec_, FaceCloser>;

constexpr char32_t kReplacement = 0xFFFD;

/// Removes the first UTF-8 character from `text` and returns it. If the first byte begins no valid character, it
/// removes that byte and returns kReplacement.
char32_t next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  char32_t c = length == 1 ? first : first & (0x7Fu >> length);
  bool good = length > 0 && length <= text.size();
  for (std::size_t i = 1; good && i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    good = (byte & 0xC0) == 0x80;
    c = c << 6 | (byte & 0x3Fu);
  }
  text.remove_prefix(good ? length : 1);
  return good ? c : kReplacement;
}

class FreeTypeFont final : public Typeface {
 public:
  FreeTypeFont(LibraryPtr library, FacePtr face) : library_(std::move(library)), face_(std::move(face)) {}

  int width(std::string_view text, int size) override {
    int pixels = 0;
    for_each_glyph(text, size, FT_LOAD_TARGET_LIGHT, [&](const FT_GlyphSlot glyph) { pixels += advance(glyph); });
    return pixels;
  }

  void draw(Image& image, int x, int y, std::string_view text, int size, Color color) override {
    for_each_glyph(text, size, FT_LOAD_TARGET_LIGHT | FT_LOAD_RENDER, [&](const FT_GlyphSlot glyph) {
      blend(image, x + glyph->bitmap_left, y - glyph->bitmap_top, glyph->bitmap, color);
      x += advance(glyph);
    });
  }

 private:
  static int advance(const FT_GlyphSlot glyph) { return int((glyph->advance.x + 32) >> 6); }

  /// Calls f for each glyph that can be loaded.
  template <class F>
  void for_each_glyph(std::string_view text, int size, FT_Int32 flags, const F& f) {
    if (FT_Set_Pixel_Sizes(face_.get(), 0, FT_UInt(size)) != 0) return;
    while (!text.empty()) {
      if (FT_Load_Char(face_.get(), next_character(text), flags) == 0) f(face_->glyph);
    }
  }

  /// Blends a glyph. Its bitmap tells how much of each pixel it covers, in 256 steps.
  static void blend(Image& image, int x, int y, const FT_Bitmap& bitmap, Color color) {
    if (bitmap.pixel_mode != FT_PIXEL_MODE_GRAY) return;
    for (int row = std::max(0, -y); row < int(bitmap.rows) && y + row < image.height; ++row) {
      const unsigned char* line = bitmap.buffer + std::ptrdiff_t(row) * bitmap.pitch;
      for (int column = std::max(0, -x); column < int(bitmap.width) && x + column < image.width; ++column) {
        Color& below = image.at(x + column, y + row);
        const auto mixed = [&](int from, int to) { return std::uint8_t(from + (to - from) * line[column] / 255); };
        below = {mixed(below.r, color.r), mixed(below.g, color.g), mixed(below.b, color.b)};
      }
    }
  }

  LibraryPtr library_;  // must outlive the face
  FacePtr face_;
};

}  // namespace

std::span<const std::string> label_font_paths() {
  static const std::vector<std::string> paths = {
      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",                  // Debian, Ubuntu
      "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",                // Fedora
      "/usr/share/fonts/TTF/DejaVuSans.ttf",                              // Arch
      "/usr/share/fonts/dejavu/DejaVuSans.ttf",                           // Alpine, older Fedora
      "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",  // Debian, Ubuntu
      "/usr/share/fonts/liberation-sans/LiberationSans-Regular.ttf",      // Fedora
      "/usr/share/fonts/liberation/LiberationSans-Regular.ttf",           // Arch
      "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",              // Debian, Ubuntu
      "/usr/share/fonts/noto/NotoSans-Regular.ttf",                       // Arch, Alpine
      "/usr/share/fonts/google-noto/NotoSans-Regular.ttf",                // Fedora
  };
  return paths;
}

std::unique_ptr<Typeface> open_label_font(std::span<const std::string> paths) {
  FT_Library opened = nullptr;
  if (FT_Init_FreeType(&opened) != 0) return nullptr;
  LibraryPtr library(opened);
  for (const std::string& path : paths) {
    FT_Face face = nullptr;
    if (FT_New_Face(library.get(), path.c_str(), 0, &face) != 0) continue;
    FacePtr owned(face);
    if (FT_IS_SCALABLE(face)) return std::make_unique<FreeTypeFont>(std::move(library), std::move(owned));
  }
  return nullptr;
}

}  // namespace bp
