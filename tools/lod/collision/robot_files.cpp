#include "tools/lod/collision/robot_files.h"

#include <fmt/format.h>

namespace bp {

namespace {

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Returns the file's name without folder and extension.
std::string stem_of(const std::string& file) {
  return file.substr(0, file.rfind('.'));
}

constexpr const char* kMadeBy = "<!-- made by bplod " BP_VERSION " -->\n";

}  // namespace

std::string mjcf_text(const std::string& name, const std::vector<std::string>& files) {
  std::string text = kMadeBy + fmt::format("<mujoco model=\"{}\">\n  <asset>\n", xml_text(name));
  for (const std::string& file : files)
    text += fmt::format("    <mesh name=\"{}\" file=\"{}\"/>\n", xml_text(stem_of(file)), xml_text(file));
  text += fmt::format("  </asset>\n  <worldbody>\n    <body name=\"{}\">\n", xml_text(name));
  // In group 3, which viewers of MuJoCo hide until the user asks for collision geoms.
  for (const std::string& file : files)
    text += fmt::format("      <geom type=\"mesh\" mesh=\"{}\" group=\"3\"/>\n", xml_text(stem_of(file)));
  return text + "    </body>\n  </worldbody>\n</mujoco>\n";
}

std::string urdf_text(const std::string& name, const std::vector<std::string>& files) {
  std::string text = kMadeBy + fmt::format("<robot name=\"{0}\">\n  <link name=\"{0}\">\n", xml_text(name));
  for (const std::string& file : files) {
    text += fmt::format(
        "    <collision name=\"{}\">\n      <geometry>\n        <mesh filename=\"{}\"/>\n      </geometry>\n"
        "    </collision>\n",
        xml_text(stem_of(file)), xml_text(file));
  }
  return text + "  </link>\n</robot>\n";
}

}  // namespace bp
