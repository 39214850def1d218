// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/document.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <initializer_list>
#include <optional>
#include <system_error>
#include <utility>

#include "geometry/formats/other_files.hpp"
#include "geometry/formats/readers.hpp"
#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

/// A file that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

std::string system_text(int error) { return std::generic_category().message(error); }

std::string read_bytes(const std::string& file) {
  if (file.empty()) throw FileError("the name of the calibration file is empty");
  // Without O_NONBLOCK, opening a pipe would wait for its other end.
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (opened.get() < 0) throw FileError(file + ": cannot be read: " + system_text(errno));
  struct stat status {};
  if (fstat(opened.get(), &status) != 0) {
    throw FileError(file + ": cannot be read: " + system_text(errno));
  }
  if (S_ISDIR(status.st_mode)) refuse_folder(file);
  if (!S_ISREG(status.st_mode)) throw FileError(file + ": is not a regular file");
  if (static_cast<std::size_t>(status.st_size) > kLargestCalibrationFile) {
    throw FileError(file + ": has " + std::to_string(status.st_size) +
                    " bytes, more than any calibration; give the file with the matrices of both "
                    "cameras, not one with maps, images or the corners of boards");
  }
  std::string bytes;
  std::array<char, 65536> block{};
  while (bytes.size() <= kLargestCalibrationFile) {
    const ssize_t count = ::read(opened.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw FileError(file + ": cannot be read: " + system_text(errno));
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
  throw FileError(file + ": grows while it is read");
}

/// The text of a file, without the mark of UTF-8.
std::string read_text(const std::string& file) {
  std::string text = read_bytes(file);
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw FileError(file + ": the file is empty");
  }
  refuse_containers(text, file);
  const bool binary = std::any_of(text.begin(), text.end(), [](char byte) {
    return byte >= 0 && byte < ' ' && byte != '\t' && byte != '\r' && byte != '\n' && byte != '\f';
  });
  if (binary) throw FileError(file + ": is a binary file, not a calibration");
  return text;
}

/// Whether the name before a separator is one of these, as in "P0: 1 0 0".
bool has_name(std::string_view line, char separator,
              std::initializer_list<std::string_view> names) {
  const std::size_t end = line.find(separator);
  if (end == std::string_view::npos) return false;
  std::string_view name = line.substr(0, end);
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// How many numbers a line has; 0 if it has anything else.
int count_numbers(std::string_view line) {
  int count = 0;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    if (word.empty()) continue;
    if (!parse_number(word)) return 0;
    ++count;
  }
  return count;
}

/// Recognises the formats that are lines of text, by the first line that belongs to one.
bool parse_as_lines(std::string_view text, Document& document) {
  // camera_calibration prints both cameras in words before it prints them as INI.
  const std::size_t ini = text.find("# oST version");
  if (ini != std::string_view::npos) text.remove_prefix(ini);
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (line.empty() || line.front() == '#' || line.front() == ';') continue;
    if (has_name(line, '=', {"cam0", "cam1", "doffs", "baseline", "width", "height", "ndisp"})) {
      document.format = Format::kMiddlebury;
      document.root = parse_lines(text, '=', document.file);
      return true;
    }
    if (has_name(line, ':', {"P0", "P1", "P2", "P3"})) {
      document.format = Format::kKittiOdometry;
      document.root = parse_lines(text, ':', document.file);
      return true;
    }
    if (has_name(line, ':',
                 {"calib_time", "corner_dist", "S_00", "S_01", "S_02", "S_03", "S_101", "K_00",
                  "K_101", "R_101", "P_rect_101"})) {
      document.format = Format::kKittiRaw;
      document.root = parse_lines(text, ':', document.file);
      return true;
    }
    if (line == "[image]") {
      document.format = Format::kCameraInfo;
      document.root = parse_camera_ini(text, document.file);
      return true;
    }
    if (line.front() == '[' && line.back() == ']' &&
        line.find_first_of(",: ") == std::string_view::npos) {
      document.format = Format::kZed;
      document.root = parse_sections(text, document.file);
      return true;
    }
    constexpr int kProjection = 12;
    constexpr int kCameraMatrix = 9;
    const int count = count_numbers(line);
    if (count == kProjection || count == kCameraMatrix) {
      document.format = count == kProjection ? Format::kKittiOdometry : Format::kFoundationStereo;
      document.root = parse_number_lines(text);
      return true;
    }
    return false;
  }
  return false;
}

std::optional<Format> known_format(const Entry& root) {
  const std::optional<Entry> camera = root.find("cam0");
  const bool chain = camera && camera->find_any({"intrinsics", "camera_model"});
  if (root.find("cameraData")) return Format::kDepthAi;
  if (root.find("camera_data_")) return Format::kArgoverse;
  if (is_dsec(root)) return Format::kDsec;
  if (is_cityscapes(root)) return Format::kCityscapes;
  if (is_basalt(root)) return Format::kBasalt;
  if (is_camera_list(root)) return Format::kCameraList;
  if (is_stella(root)) return Format::kStella;
  if (root.find("lensmodel")) return Format::kMrcal;
  if (root.find("cam0_calib")) return Format::kVins;
  if (root.find("Camera.fxl")) return Format::kOv2Slam;
  if (root.find("model_type")) return Format::kVinsCamera;
  if (is_calib_io(root)) return Format::kCalibIo;
  if (is_airslam(root)) return Format::kAirSlam;
  if (has_camera_tables(root)) return Format::kCameraTables;
  if (chain || (root.find("cam1") && !is_opencv(root))) return Format::kKalibr;
  if (root.find("T_BS")) return Format::kEuroc;
  if (is_camera_info(root)) return Format::kCameraInfo;
  if (is_orbslam(root)) return Format::kOrbSlam;
  if (is_rectified_view(root)) return Format::kRectifiedView;
  if (is_opencv(root)) return Format::kOpenCv;
  if (is_rectified_pair(root)) return Format::kRectifiedView;
  return std::nullopt;
}

/// The only map of a map, whose other entries are texts; none if that is a matrix.
const Value* only_map(const Value& map) {
  const Value* found = nullptr;
  for (const Value& item : map.items) {
    if (item.kind == Value::Kind::kScalar) continue;
    if (item.kind != Value::Kind::kMap || found != nullptr) return nullptr;
    found = &item;
  }
  const bool matrix = found != nullptr && std::find(found->names.begin(), found->names.end(),
                                                    "data") != found->names.end();
  return matrix ? nullptr : found;
}

/// Whether all is in one map that is an OpenCV file of its own, whose names need no prefix.
bool wraps_opencv(const Value& value, const std::string& file) {
  const Value* const inner = only_map(value);
  return inner != nullptr && known_format(Entry(*inner, file, {})) == Format::kOpenCv;
}

/// Adds the scalars next to a map, such as the unit, to it. Names that it already has stay as they
/// are.
void add_texts(const Value& from, Value& map) {
  for (std::size_t i = 0; i < from.names.size() && i < from.items.size(); ++i) {
    const bool known =
        std::find(map.names.begin(), map.names.end(), from.names[i]) != map.names.end();
    if (known || from.items[i].kind != Value::Kind::kScalar) continue;
    map.names.push_back(from.names[i]);
    map.items.push_back(from.items[i]);
  }
}

/// Puts the cameras of a file with two camera_info into a list, whatever their names are.
bool find_two_camera_infos(Document& document) {
  const Value& root = document.root;
  if (root.kind == Value::Kind::kScalar || root.items.size() != 2) return false;
  for (const Value& camera : root.items) {
    if (!is_camera_info(Entry(camera, document.file, {}))) return false;
  }
  document.format = Format::kCameraInfo;
  Value list;
  list.kind = Value::Kind::kList;
  list.items = root.items;
  document.root = std::move(list);
  return true;
}

/// Adds the other camera of a file with two documents. Of messages of one camera the first counts,
/// and the last one may be cut off.
void add_second_camera_info(Document& document, const std::string& text) {
  if (document.format != Format::kCameraInfo || document.entry().is_list()) return;
  Value second;
  try {
    second = parse_yaml(text, document.file, 2);
  } catch (const FileError&) {
    return;
  }
  const Entry right(second, document.file, {});
  if (!right.is_map() || !is_camera_info(right)) return;
  const Entry left = document.entry();
  for (const char* name : {"projection_matrix", "p", "P"}) {
    const std::optional<Entry> a = left.find(name), b = right.find(name);
    if (a && b && a->value() == b->value()) return;
  }
  Value list;
  list.kind = Value::Kind::kList;
  list.items = {document.root, second};
  document.root = std::move(list);
}

/// The entries of all documents, which FileStorage::APPEND adds to a file.
void add_appended(Document& document, const std::string& text) {
  if (!text.starts_with("%YAML:") || text.find("\n...") == std::string::npos) return;
  constexpr std::size_t kMost = 8;
  Value& root = document.root;
  const std::vector<Value> documents = parse_yaml_documents(text, document.file, kMost);
  for (std::size_t i = 1; i < documents.size(); ++i) {
    const Value& next = documents[i];
    if (root.kind != Value::Kind::kMap || next.kind != Value::Kind::kMap) return;
    root.names.insert(root.names.end(), next.names.begin(), next.names.end());
    root.items.insert(root.items.end(), next.items.begin(), next.items.end());
  }
}

/// The first names of a map, for a message.
std::string entries_text(const Value& root) {
  constexpr std::size_t kMost = 6;
  const std::vector<std::string>& names = root.names;
  if (names.empty()) return "has no entries with names";
  std::string text = "has";
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text += (i == 0 ? " " : ", ") + printable(names[i]);
  }
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

/// Recognises the format of a parsed file. Rigs and parameters of ROS nodes have the calibration in
/// a map, which may have scalars next to it.
void find_format(Document& document) {
  if (find_two_camera_infos(document)) return;
  const Value* inner = &document.root;
  std::string name;
  Value texts;
  while (inner != nullptr && inner->kind == Value::Kind::kMap) {
    const std::optional<Format> format = known_format(Entry(*inner, document.file, {}));
    if (format && !(format == Format::kOpenCv && wraps_opencv(*inner, document.file))) {
      document.format = *format;
      if (name.empty()) return;
      Value copy = *inner;  // it is a part of what it replaces
      add_texts(texts, copy);
      document.root = std::move(copy);
      if (*format != Format::kOpenCv) document.name = name;
      return;
    }
    add_texts(*inner, texts);
    const Value* const next = only_map(*inner);
    if (next == nullptr) break;
    const auto index = static_cast<std::size_t>(next - inner->items.data());
    name += (name.empty() ? "" : ".") + printable(inner->names[index]);
    inner = next;
  }
  if (document.entry().find("board_config")) {
    document.entry().fail(
        "describes a board of DepthAI, without its calibration; get that from the device: "
        "device.readCalibration().eepromToJsonFile(FILE) in Python");
  }
  document.entry().fail(
      "is not a calibration of a known format: it " + entries_text(document.root) +
      ". docs/calibration.md lists the formats; of rectified views, fx, fy, cx, cy and baseline "
      "(in meters) are enough, of others M1, D1, M2, D2, R and T");
}

/// Whether a text is a Python literal of mrcal; it may begin with comments.
bool is_mrcal(std::string_view text) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (line.empty() || line.front() == '#') continue;
    return line.front() == '{' && text.find("'lensmodel'") != std::string_view::npos;
  }
  return false;
}

/// Whether a text begins with a map or a comment of JSON. Parameters of ROS 2 begin with "/**:".
bool begins_as_json(std::string_view text) {
  const bool comment = text.starts_with("//") || text.starts_with("/*");
  return text.front() == '{' || (comment && !text.starts_with("/**:"));
}

}  // namespace

const char* name_of(Format format) {
  constexpr std::array<const char*, 25> kNames = {
      "an OpenCV file",
      "a ROS camera_info",
      "a Kalibr camchain",
      "a EuRoC sensor.yaml",
      "KITTI's calib_cam_to_cam",
      "KITTI's calib.txt",
      "a Middlebury calib.txt",
      "a DepthAI JSON",
      "a ZED .conf",
      "a file of ORB-SLAM",
      "a file of VINS-Fusion",
      "a camera of VINS-Fusion",
      "a file of OV2SLAM",
      "a calibration of Basalt",
      "a .cameramodel of mrcal",
      "a list of cameras (OKVIS, SVO, maplab, Spectacular AI)",
      "a file of stella_vslam",
      "a K.txt of FoundationStereo",
      "a camera of Cityscapes",
      "a cam_to_cam.yaml of DSEC",
      "a calibration of Argoverse",
      "a file with a table per camera",
      "a file of AirSLAM",
      "a file of calib.io",
      "a rectified view with a baseline"};
  return kNames[static_cast<std::size_t>(format)];
}

Document parse_document(const std::string& file) {
  const std::string text = read_text(file);
  Document document;
  document.file = file;
  const std::string_view start = std::string_view(text).substr(text.find_first_not_of(" \t\r\n"));
  refuse_reports(start, file);
  bool yaml = false;
  if (start.front() == '<') {
    document.root = parse_xml(text, file);
  } else if (is_mrcal(text)) {
    document.root = parse_mrcal(text, file);
  } else if (begins_as_json(start)) {
    document.root = parse_json(text, file);
  } else if (is_toml(text, file)) {
    document.root = parse_toml(text, file);
  } else if (!start.starts_with("%YAML") && parse_as_lines(text, document)) {
    return document;
  } else {
    document.root = parse_yaml(text, file);
    add_appended(document, text);
    yaml = true;
  }
  find_format(document);
  if (yaml) add_second_camera_info(document, text);
  return document;
}

}  // namespace mtstereo::formats
