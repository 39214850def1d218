// SPDX-License-Identifier: LGPL-2.1-or-later
// The files of OpenCV's FileStorage, with the names of its sample stereo_calib and those that
// other programs give to the same matrices, and the file of write_calibration().
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// Names of one entry with blanks between them.
using Names = std::string_view;

// Without upper case, '_', '-' and '.'.
constexpr Names kLeftMatrix =
    "m1 k1 cameramatrix1 camera1matrix cm1 intrinsics1 mtx1 cameramatrixl "
    "cameramatrixleft leftcameramatrix kl kleft leftk ml mleft mtxl mtxleft";
constexpr Names kRightMatrix =
    "m2 k2 cameramatrix2 camera2matrix cm2 intrinsics2 mtx2 cameramatrixr "
    "cameramatrixright rightcameramatrix kr kright rightk mr mright mtxr mtxright";
constexpr Names kLeftLens =
    "d1 distcoeffs1 distcoeff1 distortioncoefficients1 distortion1 dist1 distcoeffsl "
    "distcoeffsleft leftdistcoeffs leftdistortioncoefficients dl dleft leftd distl "
    "distleft dleftfe";
constexpr Names kRightLens =
    "d2 distcoeffs2 distcoeff2 distortioncoefficients2 distortion2 dist2 distcoeffsr "
    "distcoeffsright rightdistcoeffs rightdistortioncoefficients dr dright rightd distr "
    "distright drightfe";
constexpr Names kRotation = "r rotation rotationmatrix stereor rstereo rlr rmat";
constexpr Names kTranslation =
    "t translation translationvector translationmatrix stereot tstereo tlr trans tvec";
constexpr Names kSize = "imagesize imagesize1 size imgsize framesize resolution";
constexpr Names kOneCamera = "cameramatrix k mtx intrinsicmatrix";

/// The name without upper case and the characters that programs put between words.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char letter : name) {
    if (letter == '_' || letter == '-' || letter == '.') continue;
    plain += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return plain;
}

bool is_one_of(std::string_view plain, Names names) {
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find(' '));
    if (name == plain) return true;
    names.remove_prefix(std::min(name.size() + 1, names.size()));
  }
  return false;
}

/// The entries of one or two files.
class Files {
 public:
  explicit Files(std::vector<Entry> files) : files_(std::move(files)) {}

  std::optional<Entry> find(Names names) const {
    std::optional<Entry> found;
    for (const Entry& file : files_) {
      for (const std::string& name : file.value().names) {
        if (!is_one_of(plain_name(name), names)) continue;
        const std::optional<Entry> entry = file.find(name);
        if (found && found->file() == entry->file()) {
          entry->fail("states the same as " + found->name() + "; remove one of them");
        }
        if (found && !(found->value() == entry->value())) {
          entry->fail("has another value in " + found->file() + "; remove one of them");
        }
        if (!found) found = entry;
      }
    }
    return found;
  }
  /// A matrix; a single number or word with such a name has another meaning.
  std::optional<Entry> find_matrix(Names names) const {
    std::optional<Entry> found = find(names);
    const bool single =
        found && found->is_scalar() && found->text().find_first_of(" \t\n") == std::string::npos;
    return single ? std::nullopt : found;
  }
  Entry at(Names names, const char* name, const char* meaning) const {
    if (std::optional<Entry> found = find(names)) return *std::move(found);
    std::string what = std::string("there is no entry ") + name + " (" + meaning + ")";
    if (files_.size() == 1) {
      what += "; if it is in another file, give both, separated by a comma";
    } else {
      what += ", nor in " + files_[1].file();
    }
    files_[0].fail(what);
  }
  const Entry& first() const { return files_[0]; }
  bool both_have(Names names) const {
    return files_.size() == 2 && std::all_of(files_.begin(), files_.end(), [&](const Entry& file) {
             return Files({file}).find(names).has_value();
           });
  }

 private:
  std::vector<Entry> files_;
};

/// The size that the files state, or that of the caller.
void read_sizes(const Files& files, const Request& request, StereoCalibration& calibration) {
  CameraCalibration& left = calibration.left;
  const std::optional<Entry> width = files.find("imagewidth width");
  const std::optional<Entry> height = files.find("imageheight height");
  if (const std::optional<Entry> both = files.find(kSize)) {
    set_size(left, *both);
  } else if (width && height) {
    set_size(left, *width, *height);
  } else {
    left.width = request.width;
    left.height = request.height;
  }
  calibration.right.width = left.width;
  calibration.right.height = left.height;
  if (const std::optional<Entry> other = files.find("imagesize2")) {
    set_size(calibration.right, *other);
  }
}

/// The lens model that is stated, or plumb bob.
LensModel stated_lens(const Files& files, Names names, const Entry& coefficients) {
  if (const std::optional<Entry> model = files.find(names)) return lens_model(*model);
  const std::optional<Entry> model = files.find("lensmodel distortionmodel cameramodel model");
  if (model) return lens_model(*model);
  const std::optional<Entry> flag = files.find("fisheye fisheyemodel isfisheye usefisheye");
  if (flag) {
    const std::string word = flag->text();
    if (word == "1" || word == "true" || word == "True") return LensModel::kFisheye;
  }
  const std::string name = plain_name(coefficients.name());
  const bool fisheye = name.size() > 2 && name.substr(name.size() - 2) == "fe";
  return fisheye ? LensModel::kFisheye : LensModel::kPlumbBob;
}

/// The unit of T and of the fourth columns of P1 and P2 [m].
double unit_of(const Files& files) {
  const std::optional<Entry> entry = files.find("lengthunit units unit");
  if (!entry) return 1;
  const std::string word = entry->text();
  constexpr std::array<std::pair<std::string_view, double>, 9> kUnits = {{{"m", 1},
                                                                          {"meter", 1},
                                                                          {"meters", 1},
                                                                          {"cm", 0.01},
                                                                          {"centimeters", 0.01},
                                                                          {"mm", 0.001},
                                                                          {"millimeter", 0.001},
                                                                          {"millimeters", 0.001},
                                                                          {"in", 0.0254}}};
  for (const auto& [name, unit] : kUnits) {
    if (word == name) return unit;
  }
  entry->fail("is '" + printable(word) + "'; m, cm, mm or in is needed");
}

/// The rectification, if all four matrices are there.
void read_rectification(const Files& files, double unit, StereoCalibration& calibration) {
  const std::optional<Entry> r1 = files.find_matrix("r1 rl rleft");
  const std::optional<Entry> r2 = files.find_matrix("r2 rr rright");
  const std::optional<Entry> p1 = files.find_matrix("p1 pl pleft");
  const std::optional<Entry> p2 = files.find_matrix("p2 pr pright");
  if (!r1 || !r2 || !p1 || !p2) return;
  constexpr const char* kShape = "a 3x4 projection";
  const RectifiedViews views = {rotation_from(*r1), rotation_from(*r2), p1->numbers(12, kShape),
                                p2->numbers(12, kShape)};
  Rectification rectification = rectification_from(views, *p1, *p2, unit);
  rectification.width = calibration.left.width;
  rectification.height = calibration.left.height;
  if (const std::optional<Entry> size = files.find("rectifiedsize")) {
    CameraCalibration stated;
    set_size(stated, *size);
    rectification.width = stated.width;
    rectification.height = stated.height;
  }
  // The product with the focal length is rounded; write_calibration() states the length itself.
  if (const std::optional<Entry> baseline = files.find("rectifiedbaseline")) {
    const double stated = baseline->number() * unit;
    if (std::abs(stated - rectification.baseline) > 1e-6 * std::abs(stated)) {
      baseline->fail("is " + number_text(stated) + " m, but " + p2->name() + " states " +
                     number_text(rectification.baseline) + " m");
    }
    rectification.baseline = stated;
  }
  calibration.rectification = rectification;
}

std::string date_of(const Files& files) {
  const std::optional<Entry> entry =
      Files({files.first()}).find("date calibrationdate calibrationtime");
  if (!entry || !entry->is_scalar()) return {};
  std::string date = entry->text();
  // YYYY-MM-DD; OpenCV's sample "calibration" writes the words of the user's language.
  const bool iso = date.size() >= 10 && date.size() <= 40 && date[4] == '-' && date[7] == '-' &&
                   date.find_first_not_of("0123456789") == 4;
  return iso ? printable(date) : std::string();
}

}  // namespace

bool is_opencv(const Entry& file) {
  const Files files({file});
  for (const Names& names : {kLeftMatrix, kRightMatrix, kLeftLens, kRightLens, kOneCamera}) {
    if (files.find(names)) return true;
  }
  if (files.find(kRotation) && files.find(kTranslation)) return true;
  const std::vector<Value>& values = file.value().items;
  return std::any_of(values.begin(), values.end(), [&](const Value& value) {
    const Entry entry(value, file.file(), {});
    return entry.find("rows") && entry.find("dt") && entry.find("data");
  });
}

StereoCalibration read_opencv(const std::vector<Entry>& documents, const Request& request) {
  const Files files(documents);
  no_selection(files.first(), request.selection);
  if (files.both_have(kOneCamera)) {
    files.first().fail("and " + documents[1].file() +
                       " have one camera each, and neither states how they stand to each other; "
                       "calibrate them as a pair");
  }
  StereoCalibration calibration;
  const std::optional<Entry> writer = files.find("writtenby");
  calibration.format = writer && writer->text() == "mtstereo" ? "mtstereo" : "OpenCV";
  set_camera_matrix(calibration.left, files.at(kLeftMatrix, "M1", "K of the left camera"));
  set_camera_matrix(calibration.right, files.at(kRightMatrix, "M2", "K of the right camera"));
  const Entry d1 = files.at(kLeftLens, "D1", "distortion of the left camera");
  const Entry d2 = files.at(kRightLens, "D2", "distortion of the right camera");
  set_lens(calibration.left, stated_lens(files, "lensmodel1", d1), d1);
  set_lens(calibration.right, stated_lens(files, "lensmodel2", d2), d2);
  read_sizes(files, request, calibration);

  const Entry r = files.at(kRotation, "R", "rotation between the cameras");
  const Entry t = files.at(kTranslation, "T", "translation between the cameras");
  const double unit = unit_of(files);
  const std::vector<double> v = t.numbers(3, "a vector");
  Motion motion;
  motion.rotation = rotation_from(r);
  motion.translation = Eigen::Vector3d(v[0], v[1], v[2]) * unit;
  check_translation(motion.translation, t,
                    ": add the line 'length_unit: mm' to the file, or divide T by 1000");
  set_motion(calibration, motion);
  read_rectification(files, unit, calibration);
  calibration.date = date_of(files);
  return calibration;
}

}  // namespace mtstereo::formats
