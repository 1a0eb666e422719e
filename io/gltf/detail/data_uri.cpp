#include "io/gltf/detail/data_uri.h"

#include <charconv>

#include "io/gltf/base64.h"
#include "io/scene/byte_stream.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::size_t kMaxText = std::size_t(512) << 20;
constexpr std::size_t kMaxPrefix = 256;  // largest length of a data URI's beginning, up to its comma

class JsonLifter {
 public:
  JsonLifter(const SceneFilePtr& file, std::uint64_t offset, std::uint64_t size, std::string temp_dir, bool images)
      : name_(file->name()), bytes_(file, offset), left_(size), temp_dir_(std::move(temp_dir)), images_(images) {}

  LeanJson run() {
    while (left_ > 0) {
      const char c = next();
      json_.text += c;
      if (c == '"') copy_string();
      if (json_.text.size() > kMaxText)
        fail(ErrorCode::bad_input, "{}: has more than {} MiB of JSON; split the scene", name_, kMaxText >> 20);
    }
    return std::move(json_);
  }

 private:
  char next() {
    if (left_ == 0) bytes_.fail_truncated();
    --left_;
    return char(*bytes_.take(1));
  }
  void copy_string();
  [[nodiscard]] bool is_base64(std::size_t start) const;
  void lift(std::size_t start);
  void decode(ScratchFile* out);
  char escaped();
  void flush(ScratchFile* out);

  std::string name_;
  ByteStream bytes_;
  std::uint64_t left_;
  std::string temp_dir_;
  bool images_;
  LeanJson json_;
  std::shared_ptr<ScratchFile> scratch_;
  std::vector<std::byte> decoded_;
};

// Copies a string whose opening quote was read. Escapes are copied as they are.
void JsonLifter::copy_string() {
  const std::size_t start = json_.text.size();
  while (left_ > 0 && json_.text.size() <= kMaxText) {
    const char c = next();
    json_.text += c;
    if (c == '"') return;
    if (c == '\\' && left_ > 0) json_.text += next();
    if (c == ',' && is_base64(start)) return lift(start);
  }
}

bool JsonLifter::is_base64(std::size_t start) const {
  if (json_.text.size() - start > kMaxPrefix) return false;
  const std::string_view prefix = std::string_view(json_.text).substr(start);
  return prefix.starts_with("data:") && prefix.ends_with(";base64,");
}

void JsonLifter::lift(std::size_t start) {
  const bool image = !images_ && json_.text.compare(start, 11, "data:image/") == 0;
  json_.text.resize(start);
  if (image) {
    decode(nullptr);
    json_.text += "data:dropped\"";
    return;
  }
  if (!scratch_) scratch_ = std::make_shared<ScratchFile>(temp_dir_);
  const std::uint64_t begin = scratch_->size();
  decode(scratch_.get());
  json_.text += "data:lifted," + std::to_string(json_.data.size()) + "\"";
  json_.data.push_back(part_of(view_of(scratch_, name_), begin, scratch_->size() - begin));
}

// Decodes base64 up to the closing quote. Other characters are refused: programs skip them, take them as digits, or
// end there.
void JsonLifter::decode(ScratchFile* out) {
  std::uint32_t group = 0;
  int bits = 0;
  bool ended = false;
  for (char c = next(); c != '"'; c = next()) {
    if (c == '\\') c = escaped();
    ended = ended || c == '=';
    if (c == '=') continue;
    const int digit = ended ? -1 : base64_digit(c);
    if (digit < 0) fail(ErrorCode::bad_input, "{}: byte {}: broken base64 data", name_, bytes_.offset() - 1);
    group = group << 6 | std::uint32_t(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      decoded_.push_back(std::byte(group >> bits & 255));
    }
    if (decoded_.size() >= 65536) flush(out);
  }
  flush(out);
}

// Returns the character that JSON escapes as \/ or \u002B, behind its backslash; a backslash for any other escape.
char JsonLifter::escaped() {
  constexpr int kHexDigits = 4, kHex = 16, kLastAscii = 127;
  const char c = next();
  if (c != 'u') return c == '/' ? c : '\\';
  std::string hex;
  for (int i = 0; i < kHexDigits; ++i) hex += next();
  int code = 0;
  const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), code, kHex);
  const bool whole = error == std::errc() && end == hex.data() + hex.size();
  return whole && code >= 0 && code <= kLastAscii ? char(code) : '\\';
}

void JsonLifter::flush(ScratchFile* out) {
  if (out != nullptr && !decoded_.empty()) out->append(decoded_);
  decoded_.clear();
}

}  // namespace

// Counts blocks on the heap as the standard library of this platform allocates them: an object and its tree (64), a
// member with its key (112, and long keys), an array (48), an element (16, twice that while it grows), a text (48 and
// itself).
std::uint64_t bytes_to_parse(const std::string& text) {
  std::uint64_t bytes = 1024;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '{':
        bytes += 64;
        break;
      case '[':
        bytes += 48 + 32;
        break;
      case ':':
        bytes += 112;
        break;
      case ',':
        bytes += 32;
        break;
      case '"': {
        const std::size_t begin = i;
        for (++i; i < text.size() && text[i] != '"'; ++i) {
          if (text[i] == '\\') ++i;
        }
        bytes += 48 + (i - begin > 16 ? i - begin : 0);
        break;
      }
      default:
        break;
    }
  }
  return bytes;
}

LeanJson read_lean_json(const SceneFilePtr& file, std::uint64_t offset, std::uint64_t size, const std::string& temp_dir,
                        bool images) {
  return JsonLifter(file, offset, size, temp_dir, images).run();
}

}  // namespace bp
