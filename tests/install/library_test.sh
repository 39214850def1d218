#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: installation
# Feature: few dependencies
#
# Installs the build to a temporary folder, builds a program against that folder with pkg-config
# alone, runs it, and checks the exported names of the library.
#
# CPP_STANDARDS has the standards of the language to compile for, MTSTEREO_SOURCE the folder of the sources.
#
# usage: library_test.sh PROGRAM.cpp VERSION PREFIX LIBRARY_FOLDER INSTALL_TO BUILD MESON -- COMPILER...
set -eu

program=$1 version=$2 prefix=$3 library_folder=$4 install_to=$5 build=$6 meson=$7
shift 8

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() {
  echo "failed: $*" >&2
  exit 1
}

"$install_to" "$build" "$meson" "$root" || fail "meson install"

# Only the installed files: the headers are those of the sysroot, and its library has precedence.
library_path="$root$library_folder"
export PKG_CONFIG_PATH="$library_path/pkgconfig"
export PKG_CONFIG_SYSROOT_DIR="$root"
flags=$(pkg-config --cflags --libs mtstereo) || fail "pkg-config does not find mtstereo"
[ "$(pkg-config --modversion mtstereo)" = "$version" ] || fail "pkg-config reports another version"
case $flags in
  *"$root$prefix"*) ;;
  *) fail "the flags do not refer to the installed files: $flags" ;;
esac
# The program chooses the standard of the language.
for word in opencv hwy eigen -std; do
  case $flags in
    *$word*) fail "the flags have $word: $flags" ;;
  esac
done

# The flags are split into words on purpose.
# shellcheck disable=SC2086
"$@" -std=c++20 -Wall -Wextra -Wpedantic -Werror "$program" -o "$root/program" $flags ||
  fail "the program does not build with: $flags"
# include_alone HEADER...: every header can be included alone, by C++20 and by C++23.
include_alone() {
  for header in "$@"; do
    for standard in $CPP_STANDARDS; do
      # shellcheck disable=SC2086
      printf '#include <%s>\n' "${header#"$root$prefix/include/"}" |
        $compiler "-std=$standard" -Wall -Wextra -Wpedantic -Werror -fsyntax-only -x c++ - $flags ||
        fail "$header cannot be included alone with -std=$standard"
    done
  done
}
compiler=$*
include_alone "$root$prefix"/include/mtstereo/*.hpp
# An older standard ends with one clear message.
# shellcheck disable=SC2086
! echo '#include <mtstereo/mtstereo.hpp>' |
  "$@" -std=c++17 -fsyntax-only -x c++ - $flags 2>"$root/errors" || fail "C++17 is accepted"
grep -q 'needs C++20.*-std=c++20' "$root/errors" || { cat "$root/errors"; fail "C++17 is not named"; }

output=$(LD_LIBRARY_PATH="$library_path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$root/program") ||
  fail "the program exited with status $?"
echo "the program printed: $output"
[ "${output%% *}" = "$version" ] || fail "the program prints another version: $output"
[ "${output##* }" -gt 500 ] || fail "the program found too few pixels: $output"

# The same program by CMake.
if command -v cmake >/dev/null; then
  mkdir "$root/by-cmake"
  cp "$program" "$root/by-cmake/program.cpp"
  cat >"$root/by-cmake/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.18)
project(user CXX)
find_package(mtstereo ${version%.*} REQUIRED)
add_executable(user program.cpp)
target_link_libraries(user mtstereo::mtstereo)
find_package(mtstereo $((${version%%.*} + 1)).0 QUIET)
if(mtstereo_FOUND)
  message(FATAL_ERROR "another version is accepted")
endif()
END
  if ! { cmake -S "$root/by-cmake" -B "$root/by-cmake/build" -Dmtstereo_DIR="$library_path/cmake/mtstereo" &&
    cmake --build "$root/by-cmake/build"; } >"$root/cmake.log" 2>&1; then
    cat "$root/cmake.log"
    fail "CMake does not build the program"
  fi
  [ "$("$root/by-cmake/build/user")" = "$output" ] || fail "the program by CMake prints something else"
else
  echo "skipped: there is no cmake for the CMake package"
fi

# A Meson project that has the sources as its subproject finds the dependency.
mkdir -p "$root/by-meson/subprojects"
ln -s "$MTSTEREO_SOURCE" "$root/by-meson/subprojects/mtstereo"
cp "$program" "$root/by-meson/program.cpp"
cat >"$root/by-meson/meson.build" <<'END'
project('user', 'cpp', default_options: ['cpp_std=c++20'])
parts = ['gst=disabled', 'programs=disabled', 'python=disabled', 'tools=disabled', 'tests=disabled']
executable('user', 'program.cpp', dependencies: dependency('mtstereo', fallback: 'mtstereo', default_options: parts))
END
if ! PKG_CONFIG_PATH='' PKG_CONFIG_SYSROOT_DIR='' "$meson" setup "$root/by-meson/build" "$root/by-meson" \
  >"$root/meson.log" 2>&1 || ! grep -q "mtstereo *: YES" "$root/meson.log"; then
  cat "$root/meson.log"
  fail "a project with the sources as its subproject is not configured"
fi

# A program that was linked against x.y.z runs with every later x.y.* and with no other x.y.
library=$library_path/libmtstereo.so
soname=libmtstereo.so.${version%.*}
[ "$(readlink "$library_path/$soname")" = "libmtstereo.so.$version" ] ||
  fail "$soname is not a link to libmtstereo.so.$version"
readelf -d "$library" | grep -q "SONAME.*\[$soname\]" || fail "the soname is not $soname"
readelf -d "$root/program" | grep -q "NEEDED.*\[$soname\]" || fail "the program does not need $soname"

# The exported names are the public names of the library and nothing else.
nm -D --defined-only "$library" | awk '{ print $NF }' >"$root/names.txt"
grep -q '^_ZNK*8mtstereo' "$root/names.txt" || fail "the library exports nothing"
foreign=$(grep -v '^_ZNK*8mtstereo' "$root/names.txt" | c++filt || true)
[ -z "$foreign" ] || fail "the library exports names that are not its own:
$foreign"
public='(AlignmentTracker|Matcher|Parameters|RowField)::~?[A-Za-z0-9_=]+(\[abi:cxx11\])?|parameter_table|parameter_info|parameter_default|parameter_defaults_text(\[abi:cxx11\])?|find_parameter|write_disparity16|version|field_status_text|problem_name|problem_text'
internal=$(c++filt <"$root/names.txt" | grep -vE "^mtstereo::($public)\\(" || true)
[ -z "$internal" ] || fail "the library exports internal names:
$internal"
echo "exported names: $(wc -l <"$root/names.txt")"

# The library of the geometry, if the build has it. OpenCV is inside, and not in its interface.
[ -e "$library_path/pkgconfig/mtstereo-geometry.pc" ] || exit 0
flags=$(pkg-config --cflags --libs mtstereo-geometry) || fail "pkg-config does not find mtstereo-geometry"
for word in opencv eigen yaml -std; do
  case $flags in
    *$word*) fail "the flags of mtstereo-geometry have $word: $flags" ;;
  esac
done
include_alone "$root$prefix"/include/mtstereo/geometry/*.hpp
cat >"$root/geometry.cpp" <<'END'
#include <cstdio>
#include <mtstereo/geometry/calibration.hpp>
int main() {
  const auto calibration = mtstereo::read_calibration("no-such-file.yml");
  std::puts(calibration ? "read" : calibration.error().message.c_str());
}
END
# shellcheck disable=SC2086
"$@" -std=c++20 -Wall -Wextra -Wpedantic -Werror "$root/geometry.cpp" -o "$root/geometry" $flags ||
  fail "a program of the geometry does not build with: $flags"
output=$(LD_LIBRARY_PATH="$library_path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$root/geometry") ||
  fail "the program of the geometry exited with status $?"
case $output in
  *no-such-file.yml*) ;;
  *) fail "the program of the geometry printed: $output" ;;
esac
nm -D --defined-only "$library_path/libmtstereo-geometry.so" | awk '{ print $NF }' >"$root/names.txt"
foreign=$(grep -v '^_ZNK*8mtstereo' "$root/names.txt" | c++filt || true)
[ -z "$foreign" ] || fail "libmtstereo-geometry exports names that are not its own:
$foreign"
