#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# release.sh FOLDER: makes the files of a release from the commit that is checked out, in a new folder: the source
# archive, the site of the documentation, the Debian packages (tests/packages/run.sh, twice) and SHA256SUMS. Compares
# the ABI of both libraries with that of the last tag, or else with the descriptions in tests/abi/.
#
# Options:
#   --without PART   leave out a part: site, packages or abi; may be repeated
#   --before FOLDER  test that the packages of an earlier release, in this folder, are upgraded
#
# Refuses changes that are not committed, versions that differ, and a folder that is not empty. Parts whose tools are
# missing are skipped: the last lines name them, and the exit status is 3.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
repository=$(cd "$here/.." && pwd)

refuse() {
  echo "release.sh: $*" >&2
  exit "${status:-1}"
}

folder='' left_out=' ' before=()
while [ $# -gt 0 ]; do
  case $1 in
    --without)
      case ${2:-} in
        site | packages | abi) left_out+="$2 " ;;
        *) status=2 refuse "--without needs a part: site, packages or abi" ;;
      esac
      shift
      ;;
    --before)
      compgen -G "${2:-/dev/null}/*.deb" >/dev/null ||
        status=2 refuse "--before needs a folder with packages, got '${2:-}'"
      before=(--before "$(realpath "$2")")
      shift
      ;;
    --help | -h)
      sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    -*) status=2 refuse "there is no option $1 (--help lists them)" ;;
    *)
      [ -z "$folder" ] || status=2 refuse "expected one folder, got $folder and $1"
      folder=$1
      ;;
  esac
  shift
done
[ -n "$folder" ] || status=2 refuse "expected the folder to make (--help)"
folder=$(realpath -m "$folder")

# Nothing is replaced: also checked at the end, as the packages take a while.
check_folder() {
  [ ! -e "$folder" ] || { [ -d "$folder" ] && [ -z "$(ls -A "$folder")" ]; } ||
    refuse "$folder exists and is not an empty folder: name another one"
}
check_folder

cd "$repository"
[ "$(git rev-parse --show-toplevel 2>/dev/null)" = "$repository" ] || refuse "$repository is not a git checkout"
changed=$(git status --porcelain)
[ -z "$changed" ] || refuse "commit or remove these changes first:
$changed"

version=$(sed -n "s/^  version: '\(.*\)',\$/\1/p" meson.build)
noted=$(sed -n 's/^## \[\([^]]*\)\].*/\1/p' CHANGELOG.md | head -n 1)
packaged=$(sed -n '1s/^mtstereo (\([^)]*\)).*/\1/p' debian/changelog)
[ "$noted" = "$version" ] || refuse "CHANGELOG.md begins with $noted, but meson.build has version $version"
[ "$packaged" = "$version" ] ||
  refuse "debian/changelog begins with $packaged, but meson.build has version $version: debian/set-version.sh $version"

name=mtstereo-$version
commit=$(git rev-parse HEAD)
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
out=$work/out source=$work/source
mkdir "$out"
git clone -q --shared --no-checkout "$repository" "$source"
git -C "$source" checkout -q --detach "$commit"

# logged WHAT COMMAND...: runs a command; its output is printed if it fails.
logged() {
  local what=$1
  shift
  "$@" >"$work/log" 2>&1 || {
    tail -n 60 "$work/log" >&2
    refuse "failed: $what"
  }
}

# A part x has a function make_x, and needs_x, which prints why it cannot be made here.
make_archive() {
  git -c tar.umask=0022 archive --format=tar --prefix="$name/" "$commit" | gzip -9n >"$out/$name.tar.gz"
}

needs_site() {
  if [ -z "$(command -v mkdocs)" ]; then
    echo "mkdocs is missing"
  elif ! mkdocs build --help | grep -q '\[.*material'; then
    echo "mkdocs-material is missing"
  elif [ -z "$(command -v doxygen)" ]; then
    echo "doxygen is missing"
  fi
}

make_site() {
  logged mkdocs mkdocs build --strict -f "$source/docs/site/mkdocs.yml" -d "$work/$name-site"
  tar -C "$work" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
    -c "$name-site" | gzip -9n >"$out/$name-site.tar.gz"
}

needs_packages() {
  # shellcheck source=tests/packages/rooms.sh
  source tests/packages/rooms.sh
  what_is_missing
}

make_packages() {
  "$source/tests/packages/run.sh" --twice "${before[@]}" --out "$work/packages"
  cp "$work"/packages/*.deb "$out"
}

needs_abi() {
  local tool
  for tool in meson gcc abidw abidiff; do
    [ -n "$(command -v "$tool")" ] || { echo "$tool is missing" && return; }
  done
  [ "$(uname -m)" = x86_64 ] || echo "the descriptions are of x86_64"
}

make_abi() {
  local before library
  before=$(git describe --tags --abbrev=0 HEAD^ 2>/dev/null) || true
  for library in libmtstereo libmtstereo-geometry; do
    [ -z "$before" ] || git show "$before:tests/abi/$library.abi" >"$source/tests/abi/$library.abi" ||
      refuse "$before has no tests/abi/$library.abi"
  done
  echo "compared with ${before:-tests/abi/ of this commit, as there is no earlier tag}"
  logged "meson setup" env CC=gcc CXX=g++ meson setup "$work/build" "$source" -Dbuildtype=release -Dtools=disabled
  logged "the ABI tests" meson test -C "$work/build" --print-errorlogs abi abi-geometry
}

skipped=()
for part in archive site packages abi; do
  [[ $left_out != *" $part "* ]] || continue
  reason=
  [ "$part" = archive ] || reason=$("needs_$part")
  if [ -n "$reason" ]; then
    skipped+=("$part: $reason")
  else
    echo "== $part"
    "make_$part"
  fi
done

(cd "$out" && sha256sum -- * >"$work/SHA256SUMS")
check_folder
mkdir -p "$folder"
cp "$out"/* "$work/SHA256SUMS" "$folder"
echo "== $folder: version $version, commit $commit"
cat "$folder/SHA256SUMS"
[ ${#skipped[@]} -eq 0 ] || { printf 'skipped: %s\n' "${skipped[@]}" && exit 3; }
