// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/other_files.hpp"

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "geometry/formats/value.hpp"

namespace mtstereo::formats {
namespace {

namespace fs = std::filesystem;

/// A command that prints a Python dictionary as JSON.
std::string conversion(const std::string& modules, const std::string& dictionary,
                       const std::string& argument) {
  const bool plain = argument.find_first_of("'\n") == std::string::npos;
  return "python3 -c \"import json,sys," + modules + ";print(json.dumps({" + dictionary + "}))\" " +
         (plain ? "'" + argument + "'" : "FILE") + " > converted.json, and give converted.json";
}

/// The command for a folder of NumPy arrays; large ones are maps.
std::string conversion_of_arrays(const fs::path& folder) {
  return conversion("glob,os.path as p,numpy as n",
                    "p.basename(f)[:-4]:n.load(f).tolist()for f in glob.glob(sys.argv[1]+'/*.npy')"
                    "if n.load(f).size<99",
                    folder.empty() ? "." : folder.string());
}

/// Fails for several arrays in one file of Python or MATLAB.
void refuse_dictionaries(std::string_view text, const std::string& file) {
  if (text.starts_with("PK\x03\x04") && text.substr(0, 200).find(".npy") != text.npos) {
    throw FileError(file + ": is a NumPy .npz; convert it: " +
                    conversion("numpy as n",
                               "k:v.tolist()for k,v in n.load(sys.argv[1]).items()if v.size<99",
                               file));
  }
  // The first protocol is text, the others have a number.
  constexpr char kLatest = 5;
  const bool numbered = text.size() > 2 && text[0] == '\x80' && text[1] > 0 && text[1] <= kLatest;
  if (numbered || text.starts_with("(dp0\n") || text.starts_with("(dp1\n")) {
    throw FileError(file + ": is a Python pickle; convert its dictionary: " +
                    conversion("pickle,numpy as n",
                               "k:n.asarray(v).tolist()for k,v in "
                               "pickle.load(open(sys.argv[1],'rb')).items()",
                               file));
  }
  if (text.starts_with("MATLAB 5.0")) {
    throw FileError(file + ": is a MATLAB .mat; convert its matrices: " +
                    conversion("scipy.io as s",
                               "k:v.tolist()for k,v in s.loadmat(sys.argv[1]).items()if "
                               "hasattr(v,'tolist')",
                               file) +
                    "; of an object stereoParams, write what stereoParametersToOpenCV states, with "
                    "the names M1, D1, M2, D2, R, T, by jsonencode");
  }
}

/// A file by two texts in it, and what to do instead of giving it.
struct OtherFile {
  std::string_view mark, other_mark;
  const char* what;
};

constexpr std::array<OtherFile, 7> kOtherFiles = {{
    {"Intrinsic of \"Infrared 1\"", "",
     "is a list of rs-enumerate-devices; write what it states for the size of the video to a YAML "
     "file: fx, fy, cx (PPX), cy (PPY) of Infrared 1, and baseline, the first value of the "
     "translation between Infrared 1 and 2"},
    {"\"aux-param-", "",
     "has settings of a RealSense camera, not its calibration; give what rs-enumerate-devices -c "
     "states for it"},
    {"in_left", "  coeffs:",
     "is of the SDK of MYNT EYE; write in_left as M1: [fx, 0, cx, 0, fy, cy, 0, 0, 1] and D1 "
     "(coeffs), in_right as M2 and D2, rotation as R, translation as T, and length_unit: mm"},
    {"type_of_vi", "cam1_intrinsics",
     "is of FLVIS; write both intrinsics as M1: [fx, 0, cx, 0, fy, cy, 0, 0, 1] and M2, the "
     "coefficients as D1 and D2, and as R and T the pose of cam0 in the axes of cam1 (the "
     "inverse of T_cam0_cam1)"},
    {"\"intrinsic_settings\"", "\"captured_image_size\"",
     "is of NDDS, without a baseline; write fx, fy, cx, cy and the baseline that the data set "
     "states to a YAML file"},
    {"\"distortion_params\"", "\"principal\"",
     "is an .edex of cuVSLAM; give the camera_info of both cameras (LEFT,RIGHT), or write K and "
     "distortion of both, R and T [m] to a YAML file with the names M1, D1, M2, D2, R, T"},
    {"ParGroup: Camera", "",
     "is of HALCON, whose lens model is another one; calibrate the cameras as a pair "
     "(mtcalibrate)"},
}};

/// The program of structure from motion that wrote a text; "" if none did.
std::string_view reconstruction_program(std::string_view text) {
  for (const std::string_view start :
       {"# Camera list with", "# Image list with", "# Rig calib list", "# Frame list with"}) {
    if (text.starts_with(start)) return "COLMAP";
  }
  const auto has = [&](std::string_view entry) { return text.find(entry) != text.npos; };
  if (has("\"image_prefix\"")) return "COLMAP";
  if (has("\"fl_x\"")) return "nerfstudio";
  if (has("\"camera_angle_x\"")) return "NeRF";
  if (has("\"sfm_data_version\"")) return "OpenMVG";
  if (has("\"projection_type\"")) return "OpenSfM";
  if (has("\"priors\"") && has("\"image_name\"")) return "Theia";
  if (has("<chunk ") || has("<projection>frame")) return "Metashape";
  return has("\"intrinsicId\"") ? "Meshroom" : "";
}

}  // namespace

[[noreturn]] void refuse_folder(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() != ".npy") continue;
    throw FileError(folder +
                    ": is a folder of NumPy arrays; convert them: " + conversion_of_arrays(folder));
  }
  throw FileError(folder + ": is a folder, a file is needed");
}

void refuse_containers(const std::string& text, const std::string& file) {
  const std::string_view start(text);
  refuse_dictionaries(start, file);
  if (start.starts_with("\x93NUMPY")) {
    throw FileError(file + ": is a NumPy array; convert all arrays of its folder: " +
                    conversion_of_arrays(fs::path(file).parent_path()));
  }
  if (start.starts_with("\x89HDF")) {
    throw FileError(file +
                    ": is an HDF5 file, as MATLAB's .mat; write its matrices to a YAML or JSON "
                    "file with the names M1, D1, M2, D2, R, T");
  }
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff")) {
    throw FileError(file +
                    ": is a text in UTF-16, as PowerShell writes it; convert it to UTF-8 "
                    "(iconv -f utf-16 -t utf-8)");
  }
  constexpr std::size_t kTarMark = 257;
  const bool tar = start.size() > kTarMark && start.substr(kTarMark).starts_with("ustar");
  if (tar || start.starts_with("\x1f\x8b") || start.starts_with("PK\x03\x04")) {
    throw FileError(file + ": is compressed or an archive; unpack it (" +
                    (tar               ? "tar xf"
                     : start[0] == 'P' ? "unzip"
                                       : "tar xzf, or gunzip") +
                    ") and give the calibration in it");
  }
}

void refuse_reports(std::string_view start, const std::string& file) {
  if (start.starts_with("Calibration results")) {
    throw FileError(file + ": is a report of Kalibr; give its camchain, a YAML file");
  }
  if (start.starts_with("version https://git-lfs")) {
    throw FileError(file +
                    ": is a pointer of Git LFS without the calibration; get it (git lfs pull)");
  }
  if (start.starts_with("<!DOCTYPE html") || start.starts_with("<html")) {
    throw FileError(file + ": is a web page; download the file itself");
  }
  for (const OtherFile& other : kOtherFiles) {
    if (start.find(other.mark) == start.npos || start.find(other.other_mark) == start.npos)
      continue;
    throw FileError(file + ": " + other.what);
  }
  if (const std::string_view program = reconstruction_program(start); !program.empty()) {
    throw FileError(file + ": is of " + std::string(program) +
                    ", whose lengths have no unit; write K, distortion, R and T [m] of "
                    "one pair to a YAML file with the names M1, D1, M2, D2, R, T, or calibrate the "
                    "cameras as a pair (mtcalibrate)");
  }
  const auto has = [&](std::string_view entry) { return start.find(entry) != start.npos; };
  if ((has("RotationOfCamera2") || has("PoseCamera2")) && !has("IntrinsicMatrix") &&
      (has("\"RadialDistortion\"") || has("stereoParameters with properties"))) {
    throw FileError(file +
                    ": is of MATLAB's stereoParameters, whose rotation is transposed; write what "
                    "stereoParametersToOpenCV states to a YAML or JSON file with the names M1, D1, "
                    "M2, D2, R, T");
  }
  if (start.front() == '%' && !start.starts_with("%YAML") && !start.starts_with("%TAG")) {
    throw FileError(file +
                    ": is a MATLAB script; write its matrices to a YAML file with the names M1, "
                    "D1, M2, D2, R, T, as OpenCV states them (stereoParametersToOpenCV)");
  }
}

}  // namespace mtstereo::formats
