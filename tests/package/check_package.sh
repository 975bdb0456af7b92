#!/usr/bin/env bash
# Runs one task of the package tests, in folder $WORK: check_package.sh TASK. CMakeLists.txt sets the rest of the
# environment.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
consumer=$here/consumer
prefix=$WORK/moved
sky=$WORK/sky.tif
unset CMAKE_PREFIX_PATH LD_LIBRARY_PATH PKG_CONFIG_PATH bdpt_DIR bdpt_ROOT
export ASAN_OPTIONS=detect_leaks=0  # ignores leaks of OpenImageIO

skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}

fail() {
  printf 'failed: %s\n' "$*" >&2
  exit 1
}

# build_consumer FOLDER TARGET CMAKE-OPTIONS...: configures and builds the consumer project.
build_consumer() {
  local folder=$1 target=$2
  shift 2
  "$CMAKE" -S "$consumer" -B "$folder" -G "$GENERATOR" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$LAUNCHER" -DBDPT_WANTED_VERSION="$VERSION" "$@"
  "$CMAKE" --build "$folder" --parallel 2 --target "$target"
}

# expect_version PROGRAM: runs it; its first line must be our version.
expect_version() {
  local said
  said=$("$@")
  printf '%s\n' "$said"
  [[ ${said%%$'\n'*} == "bdpt $VERSION" ]] || fail "$1 is not version $VERSION"
}

# Writes a TIFF of one pixel of (1, 1, 1) in floats [TIFF 6.0]: the header, the pixel, and entries of tags from 256 to
# 511 as LOW-BYTE-OF-TAG:VALUE.
write_tiff() {
  printf 'II*\0\x14\0\0\0\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f\x0a\0'
  local entry
  for entry in 00:01 01:01 02:20 03:01 06:02 11:08 15:03 16:01 17:0c 53:03; do
    # The format string contains the bytes.
    # shellcheck disable=SC2059
    printf "\\x${entry%:*}\\x01\\x04\\0\\x01\\0\\0\\0\\x${entry#*:}\\0\\0\\0"
  done
  printf '\0\0\0\0'
}

install_and_move() {
  rm -rf "$WORK/installed" "$prefix"
  mkdir -p "$WORK"
  "$CMAKE" --install "$BUILD" --config "$CONFIG" --prefix "$WORK/installed" >"$WORK/install.log"
  # Moves the installation, to detect a package that stores its first location.
  mv "$WORK/installed" "$prefix"
  # Only OpenImageIO reads this format.
  write_tiff >"$sky"
  check_names "$prefix" "$BUILD" "$SOURCE" "$WORK"
}

# check_names FOLDER PATH...: fails if a file in FOLDER contains one of the paths, where others could place code that we
# then run. Debug information may.
check_names() {
  local folder=$1 file pattern found=""
  shift
  pattern=$(printf '|\\Q%s\\E(?![-\\w])' "${@%/}")  # Not /src/project-config.
  while IFS= read -r file; do
    cp "$file" "$WORK/no-debug"
    strip --strip-debug "$WORK/no-debug" 2>/dev/null || true  # Other files are checked as they are.
    if LC_ALL=C grep -qaP "${pattern:1}" "$WORK/no-debug"; then
      found+=" $file ($(LC_ALL=C grep -aoP "${pattern:1}" "$WORK/no-debug" | sort | uniq -c | sort -rn | sed -n 1p))"
    fi
  done < <(find "$folder" -type f)
  rm -f "$WORK/no-debug"
  [[ -z $found ]] || fail "these files name the build:$found"
}

run_command() {
  expect_version "$prefix/bin/bdpt" --version
  rm -f "$WORK"/loaded.* "$WORK/out.png"
  LD_DEBUG=files LD_DEBUG_OUTPUT=$WORK/loaded "$prefix/bin/bdpt" render \
    "$SOURCE/scenes/furnace.gltf" --env "$sky" -o "$WORK/out.png" --size 16x16 --spp 1 --quiet
  [[ -s $WORK/out.png ]] || fail "no image"
  local loaded
  loaded=$(sed -n 's/.*calling init: \(.*libbdpt.*\)/\1/p' "$WORK"/loaded.*)
  printf '%s\n' "$loaded"
  grep -q libbdpt_oiio <<<"$loaded" || fail "the module of OpenImageIO was not loaded"
  ! grep -v "^$prefix/bin/\.\./\|^$prefix/$LIBDIR/" <<<"$loaded" || fail "not from $prefix"
}

# Tests the component without OpenImageIO.
run_without_module() {
  local slim=$WORK/slim
  rm -rf "$slim"
  "$CMAKE" --install "$BUILD" --config "$CONFIG" --prefix "$slim" --component bdpt_runtime >/dev/null
  ! find "$slim" -name '*oiio*' | grep . || fail "the module is among what needs no OpenImageIO"
  printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81' >"$slim/sky.hdr"
  local words=(render "$SOURCE/scenes/furnace.gltf" -o "$slim/out.png" --size 16x16 --spp 1 --quiet)
  "$slim/bin/bdpt" "${words[@]}" --env "$slim/sky.hdr"
  rm "$slim/out.png"
  local said code=0
  said=$("$slim/bin/bdpt" "${words[@]}" --env "$sky" 2>&1) || code=$?
  printf '%s\n' "$said"
  [[ $code == 5 && $(wc -l <<<"$said") == 1 ]] || fail "exit code $code"
  [[ $said == "bdpt: error: $sky: TIFF images are read by OpenImageIO: libbdpt_oiio.so not found (tried "*
  ]] || fail "another error"
  [[ ! -e $slim/out.png ]] || fail "an image without its environment"
  code=0
  said=$("$slim/bin/bdpt" "${words[@]}" --volume "$SOURCE/scenes/smoke.vdb" 2>&1) || code=$?
  printf '%s\n' "$said"
  [[ $code == 5 && $(wc -l <<<"$said") == 1 ]] || fail "exit code $code"
  [[ $said == "bdpt: error: "*"smoke.vdb: OpenVDB files are read by a separate program: bdpt-read-vdb not found (tried "*
  ]] || fail "another error"
  [[ ! -e $slim/out.png ]] || fail "an image without its volume"
}

# put_companions_beside FOLDER: puts the companions beside programs in FOLDER. A shared library has them beside itself.
put_companions_beside() {
  [[ $SHARED == 1 ]] || cp -r "$prefix/$LIBDIR/bdpt" "$1"
}

use_find_package() {
  rm -rf "$WORK/find_package"
  build_consumer "$WORK/find_package" all -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS="$FLAGS"
  grep "^bdpt_DIR:PATH=$prefix/" "$WORK/find_package/CMakeCache.txt" || fail "not from $prefix"
  local said
  said=$("$CMAKE" -S "$consumer" -B "$WORK/find_package/other" -G "$GENERATOR" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_PREFIX_PATH="$prefix" -DBDPT_MORE_COMPONENTS=gltf 2>&1) && fail "found a component gltf"
  grep -q "bdpt has no component gltf" <<<"$said" || fail "no reason: $said"
  put_companions_beside "$WORK/find_package"
  expect_version "$WORK/find_package/render_box"
  "$WORK/find_package/read_sky" "$sky"
  "$WORK/find_package/judge"
  (cd "$WORK/find_package" && ./run_job "$SOURCE/scenes/furnace.gltf" "$sky")
}

# compile PROGRAM SOURCE PACKAGE: compiles by hand. Hidden visibility in the program must not hide exceptions of the
# library. A program links the libraries that it calls; they find the others.
compile() {
  local words=(--cflags --libs)
  [[ $SHARED == 1 ]] || words+=(--static)
  # Flags must be split into words.
  # shellcheck disable=SC2046,SC2086
  $LAUNCHER "$CXX" -std=c++20 -O1 -fvisibility=hidden $FLAGS "$2" -o "$1" \
    -Wl,--as-needed -Wl,-rpath,"$prefix/$LIBDIR" $("$PKG_CONFIG" "${words[@]}" "$3")
}

use_pkg_config() {
  export PKG_CONFIG_PATH=$prefix/$LIBDIR/pkgconfig
  [[ $("$PKG_CONFIG" --modversion bdpt) == "$VERSION" ]] || fail "bdpt.pc: not version $VERSION"
  rm -rf "$WORK/pkg-config"
  mkdir -p "$WORK/pkg-config"
  cd "$WORK/pkg-config"
  compile render_box "$consumer/render_box.cpp" bdpt
  expect_version ./render_box
  compile read_sky "$consumer/read_sky.cpp" bdpt_io
  put_companions_beside .
  ./read_sky "$sky"
  compile judge "$consumer/judge.cpp" bdpt_eval
  ./judge
  compile run_job "$consumer/run_job.cpp" bdpt_job
  ./run_job "$SOURCE/scenes/furnace.gltf" "$sky"

  # Builds the programs in the README and in the page about the library, with fewer pixels.
  ln -s "$SOURCE/scenes" scenes
  local page program image package
  for page in README.md docs/library.md; do
    awk -v name="$(basename "$page" .md)" \
      '/^```cpp$/ {inside = 1; ++number; next} /^```$/ {inside = 0} inside {print >(name number ".cpp")}' \
      "$SOURCE/$page"
  done
  for program in README?.cpp library?.cpp; do
    sed -i 's/512/16/g; s/{0, 64}/{0, 1}/' "$program"
    package=bdpt_io
    ! grep -q "<bdpt/job.h>" "$program" || package=bdpt_job
    compile "${program%.cpp}" "$program" "$package"
    "./${program%.cpp}"
  done
  for image in out.exr growing.exr edited.exr built.exr job.exr job.png; do
    [[ -s $image ]] || fail "no program in the documentation wrote $image"
  done
}

# configure_subdirectory FOLDER CMAKE-OPTIONS...: configures a project that has bdpt as a part. It must not look for the
# libraries of the tests.
configure_subdirectory() {
  local folder=$1 target=$2 unneeded=() package
  shift 2
  for package in Catch2 Python3 benchmark; do
    unneeded+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
  done
  build_consumer "$folder" "$target" -DBDPT_SOURCE="$SOURCE" -DBDPT_BUILD_IO=ON "${unneeded[@]}" "$@"
  [[ -n $(find "$folder/bdpt" -name 'unity_0_cxx.cxx' -print -quit) ]] || fail "not a unity build"
}

# Compiles one file of a project that has bdpt as a part, and nothing of bdpt.
compile_in_project() {
  rm -rf "$WORK/in_project"
  configure_subdirectory "$WORK/in_project" render_box_object -DCMAKE_BUILD_TYPE=Release
}

# Builds the libraries as a part of a project: static, with bdpt::io, and as a unity build, by default. Keeps the last
# build. Everything has sanitizers, and the targets of tests/fuzz are built too, with libFuzzer if a compiler has it, for
# tests that run them; they need parts of the command.
use_add_subdirectory() {
  local folder=$WORK/add_subdirectory
  mkdir -p "$WORK"
  if [[ -n $FUZZER_CXX ]]; then
    CXX=$FUZZER_CXX
  else
    echo "no clang++ with libFuzzer: the fuzz targets only run mutants of seeds"
  fi
  configure_subdirectory "$folder" programs -DBDPT_BUILD_EVAL=ON -DBDPT_BUILD_APPS=ON -DBDPT_BUILD_FUZZERS=ON \
    -DBDPT_SANITIZE=address,undefined -DCMAKE_EXE_LINKER_FLAGS=-fsanitize=address,undefined \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
  expect_version "$folder/render_box"
  write_tiff >"$folder/sky.tif"
  local files=("$SOURCE/scenes/cornell-box.gltf" "$folder/sky.tif")
  [[ $OPENVDB != 1 ]] || files+=("$SOURCE/scenes/smoke.vdb")
  # The program must find the reader beside itself, and not one in the current folder.
  local trap=$folder/trap
  rm -rf "$trap"
  mkdir "$trap"
  touch "$trap/read_scene"
  printf '#!/bin/sh\ntouch "%s"\n' "$trap/caught" >"$trap/bdpt-read-vdb"
  chmod +x "$trap/bdpt-read-vdb"
  (cd "$trap" && PATH=$folder:$PATH read_scene "${files[@]}")
  [[ -s $trap/read_scene.exr ]] || fail "no image"
  (cd "$trap" && "$folder/run_job" "$SOURCE/scenes/furnace.gltf" "$folder/sky.tif")
  [[ ! -e $trap/caught ]] || fail "a program of the current folder was run"
}

# Builds a wheel like "pip wheel .", by the system's compiler, with warnings as errors, without LTO and as a unity build,
# which takes less time. Deletes the sources before the wheel is tested, in an environment of its own.
make_wheel() {
  local folder=$WORK/wheel python name
  rm -rf "$folder"
  mkdir -p "$folder"
  "$PYTHON3" -c 'import sysconfig, os; assert os.path.exists(sysconfig.get_path("include") + "/Python.h")' \
    && "$PYTHON3" -m venv "$folder/venv" || skip "no python3-venv or python3-dev"
  python=$folder/venv/bin/python
  local pip=("$python" -m pip --disable-pip-version-check --retries 1 --timeout 20)
  "${pip[@]}" install -q numpy scikit-build-core || skip "pip does not reach packages (no network?)"
  mkdir "$folder/source" "$folder/tmp"
  for name in CMakeLists.txt pyproject.toml LICENSE README.md CHANGELOG.md apps cmake docs lib; do
    cp -r "$SOURCE/$name" "$folder/source/"
  done
  TMPDIR=$folder/tmp CMAKE_BUILD_PARALLEL_LEVEL=2 CXX=c++ "${pip[@]}" wheel "$folder/source" --no-deps -w "$folder" \
    --config-settings=cmake.build-type=Debug --config-settings=cmake.define.CMAKE_CXX_FLAGS_DEBUG=-O2 \
    --config-settings=cmake.define.BDPT_COMMAND_OPTIMIZATION=-O1 \
    --config-settings=cmake.define.BDPT_WERROR=ON --config-settings=cmake.define.CMAKE_UNITY_BUILD=ON \
    --config-settings=cmake.define.CMAKE_UNITY_BUILD_BATCH_SIZE=32 \
    --config-settings=cmake.define.CMAKE_CXX_COMPILER_LAUNCHER="$LAUNCHER"
  rm -rf "$folder/source" "$folder/tmp"
  "${pip[@]}" uninstall -q -y scikit-build-core
  "$python" -m zipfile -e "$folder"/bdpt-"$VERSION"-*.whl "$folder/unpacked"
  check_names "$folder/unpacked" "$folder" "$SOURCE" "$BUILD" /tmp/
  "${pip[@]}" install -q --no-index "$folder"/bdpt-"$VERSION"-*.whl
  local package
  package=$(cd "$folder" && "$python" -c 'import bdpt, pathlib; print(pathlib.Path(bdpt.__file__).parent)')
  [[ $package == "$folder/venv/"* ]] || fail "imported $package"
  "${pip[@]}" show -f bdpt | sed -n '/^Files:/,$p' | grep -v '^Files:\|^  bdpt/\|^  bdpt-\|/bin/bdpt$' \
    && fail "files outside of the package"
  write_tiff >"$folder/sky.tif"
  mkdir "$folder/elsewhere" "$folder/scenes"
  cp "$SOURCE"/scenes/{cornell-box.gltf,material-layers.gltf,room-spot.gltf,smoke.vdb} "$folder/scenes"
  (cd "$folder/elsewhere" && "$python" "$here/check_wheel.py" .. "$VERSION" "$OPENVDB" "$SOURCE/docs/python.md" \
    "$FAKE_OIDN" "$BUILD/apps/bdpt")
}

# Configures with BDPT_BUILD_IO=OFF and nothing else: the core and its tests, without looking for the libraries of the
# rest.
configure_core_alone() {
  local unneeded=() package
  for package in OpenImageIO OpenEXR Imath PNG JPEG WebP nlohmann_json fmt CLI11 benchmark; do
    unneeded+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
  done
  local folder=$WORK/core_alone
  rm -rf "$folder"
  mkdir -p "$WORK"
  "$CMAKE" -S "$SOURCE" -B "$folder" -G "$GENERATOR" -DCMAKE_CXX_COMPILER="$CXX" \
    -DBDPT_BUILD_IO=OFF "${unneeded[@]}" | tee "$WORK/core_alone.log"
  grep -q "the command and its tests are left out" "$WORK/core_alone.log" || fail "does not say so"
  local targets
  targets=$("$CMAKE" --build "$folder" --target help)
  grep -q '\bbdpt_unit_tests\b' <<<"$targets" || fail "no tests of the core"
  ! grep -E '\bbdpt_(io|app|command|apps_tests|io_tests)\b' <<<"$targets" || fail "more than the core"
}

# Builds the Debian packages; unpacks them without installing.
make_debian_packages() {
  if ! command -v dpkg-shlibdeps >/dev/null; then
    skip "dpkg-dev is not installed"
  fi
  local folder=$WORK/debian
  rm -rf "$folder"
  (cd "$BUILD" && cpack -G DEB -C "$CONFIG" -B "$folder")
  local command=$folder/bdpt_${VERSION}_*.deb headers=$folder/libbdpt-dev_${VERSION}_*.deb depends
  local module=$folder/bdpt-openimageio_${VERSION}_*.deb
  # All package names end with the architecture.
  # shellcheck disable=SC2086
  depends=$(dpkg-deb -f $command Depends)
  [[ $depends == *libembree*libtbb* && $depends != *openimageio* ]] || fail "bdpt depends on: $depends"
  # shellcheck disable=SC2086
  [[ $(dpkg-deb -f $command Suggests) == "bdpt-openimageio, bdpt-openvdb" ]] || fail "bdpt suggests something else"
  # shellcheck disable=SC2086
  depends=$(dpkg-deb -f $module Depends)
  [[ $depends == *"bdpt (= $VERSION)"* && $depends == *libopenimageio* ]] \
    || fail "bdpt-openimageio depends on: $depends"
  # shellcheck disable=SC2086
  depends=$(dpkg-deb -f $headers Depends)
  [[ $depends == "bdpt (= $VERSION), libglm-dev" ]] || fail "libbdpt-dev depends on: $depends"
  # shellcheck disable=SC2086
  dpkg-deb -x $command "$folder/unpacked"
  # shellcheck disable=SC2086
  dpkg-deb -x $headers "$folder/unpacked"
  [[ -z $(find "$folder/unpacked" -name '*oiio*') ]] || fail "the module is in the package bdpt"
  # shellcheck disable=SC2086
  dpkg-deb -x $module "$folder/unpacked"
  check_volume_package "$folder"
  expect_version "$folder/unpacked/usr/bin/bdpt" --version
  local file
  for file in share/man/man1/bdpt-render.1.gz share/bash-completion/completions/bdpt \
    share/zsh/vendor-completions/_bdpt share/fish/vendor_completions.d/bdpt.fish \
    share/doc/bdpt/copyright share/doc/bdpt/changelog.gz share/doc/bdpt/docs/render.md include/bdpt/render.h \
    lib/bdpt/libbdpt_oiio.so lib/bdpt/bdpt-read-ktx lib/libbdpt.so lib/cmake/bdpt/bdptConfig.cmake; do
    [[ -s $folder/unpacked/usr/$file ]] || fail "no $file"
  done
  check_python_package "$folder"
  check_descriptions "$folder"
  check_policy "$folder"
}

# Checks Debian's policy with lintian.
check_policy() {
  if ! command -v lintian >/dev/null; then
    echo "lintian is not installed: the packages are not held against Debian's policy"
    return
  fi
  local said
  said=$(lintian --allow-root --tag-display-limit 0 "$1"/*_"${VERSION}"_*.deb) || true
  printf '%s\n' "$said"
  ! grep -E '^(E|W):' <<<"$said" || fail "lintian has found errors or warnings"
}

# Tests that each package states its purpose and its licence.
check_descriptions() {
  local package name line
  for package in "$1"/*_"${VERSION}"_*.deb; do
    name=$(dpkg-deb -f "$package" Package)
    grep -q "^License: Apache License, Version 2.0" "$1/unpacked/usr/share/doc/$name/copyright" \
      || fail "no licence in $package"
    dpkg-deb -f "$package" Description | sed -n 1p  # head would end before all is written
  done > "$1/descriptions"
  line=$(sort "$1/descriptions" | uniq -d)
  [[ -z $line ]] || fail "several packages are called: $line"
}

# Tests bdpt-openvdb, if the build has OpenVDB.
check_volume_package() {
  local folder=$1 packages depends
  packages=("$folder"/bdpt-openvdb_"${VERSION}"_*.deb)
  if [[ $OPENVDB != 1 ]]; then
    [[ ! -e ${packages[0]} ]] || fail "a package that has nothing"
    return
  fi
  depends=$(dpkg-deb -f "${packages[0]}" Depends)
  [[ $depends == *"bdpt (= $VERSION)"* && $depends == *libopenvdb* ]] || fail "bdpt-openvdb depends on: $depends"
  [[ -z $(find "$folder/unpacked" -name 'bdpt-read-vdb') ]] || fail "the reader of volumes is in another package"
  dpkg-deb -x "${packages[0]}" "$folder/unpacked"
  [[ -x $(find "$folder/unpacked" -name 'bdpt-read-vdb') ]] || fail "bdpt-openvdb has no program"
  "$folder/unpacked/usr/bin/bdpt" render "$SOURCE/scenes/cornell-box.gltf" --volume "$SOURCE/scenes/smoke.vdb" \
    -o "$folder/smoke.png" --size 16x16 --spp 1 --quiet
}

# Tests python3-bdpt with the Python it is built for. Only Debian's Python makes a package.
check_python_package() {
  local folder=$1 packages
  packages=("$folder"/python3-bdpt_"${VERSION}"_*.deb)
  if [[ -z $PYTHON_DEPENDS ]]; then
    [[ ! -e ${packages[0]} ]] || fail "a package for a Python that is not Debian's"
    echo "no package python3-bdpt: the Python package is not built, or not with Debian's Python"
    return
  fi
  local depends usr=$folder/unpacked/usr
  depends=$(dpkg-deb -f "${packages[0]}" Depends)
  [[ $depends == "bdpt (= $VERSION), $PYTHON_DEPENDS, "*libstdc++6* ]] || fail "python3-bdpt depends on: $depends"
  # Finds the Python ABI of the module.
  local abi
  abi=$(dpkg-deb -c "${packages[0]}" | sed -n 's/.*_bdpt\.cpython-3\([0-9]*\)-.*/\1/p')
  [[ $depends == *"python3 (>= 3.$abi), python3 (<< 3.$((abi + 1))), python3-numpy"* ]] \
    || fail "python3-bdpt with a module for Python 3.$abi depends on: $depends"
  dpkg-deb -x "${packages[0]}" "$folder/unpacked"
  dpkg-deb -e "${packages[0]}" "$folder/control"
  [[ -x $folder/control/postinst && -x $folder/control/prerm ]] || fail "nothing removes what Python compiles"
  check_python "$usr" lib/python3/dist-packages debian
}

# check_python PREFIX FOLDER INSTALLER: tests the Python package in a folder of an installation.
check_python() {
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$1/$2 "$PYTHON" "$here/check_python.py" \
    "$@" "$1/bin/bdpt" "$SOURCE/scenes/cornell-box.gltf" "$VERSION"
}

# Tests the installed Python package: what the build has compiled, where the wheel compiles all of it again.
check_installed_python() {
  local installer=cmake
  [[ -z $PYTHON_DEPENDS ]] || installer=debian
  check_python "$prefix" "$PYTHON_FOLDER" "$installer"
}

# Builds the archive with its libraries, with little compression.
make_archive() {
  local program folder=$WORK/archive name=bdpt-$VERSION-linux-$(uname -m) components=bdpt_runtime
  for program in patchelf xz readelf; do
    command -v "$program" >/dev/null || skip "$program is not installed"
  done
  rm -rf "$folder"
  mkdir -p "$folder"
  [[ $OPENVDB != 1 ]] || components+=";bdpt_openvdb"
  mkdir -p "$folder/denoiser/lib"
  cp "$FAKE_OIDN" "$folder/denoiser/lib/libOpenImageDenoise.so.2"
  cp "$SOURCE/cmake/archive/third-party-programs.txt" "$folder/denoiser"
  mkdir "$folder/ktx"
  cp "$FAKE_KTX" "$folder/ktx/libktx.so"
  "$CMAKE" -DBUILD="$BUILD" -DCONFIG="$CONFIG" -DNAME="$name" -DCOMPONENTS="$components" -DLIBDIR="$LIBDIR" \
    -DFOLDER="$folder" -DDENOISER="$folder/denoiser" -DKTX="$folder/ktx" -DOBJDUMP="$(command -v objdump)" -DLEVEL=0 -P "$SOURCE/cmake/archive/make_archive.cmake"
  check_names "$BUILD/archive" "$BUILD" "$SOURCE" "$WORK"
  rm -rf "$BUILD/archive"
  "$PYTHON3" "$here/check_archive.py" "$folder/$name.tar.xz" "$folder" "$SOURCE/scenes" "$VERSION" "$OPENVDB"
  rm -rf "$folder"
}

# Tests installed completions, which shells find by the name of the command.
check_completions() {
  "$PYTHON3" "$SOURCE/tests/apps/completion_test.py" --installed "$prefix/share" "$1"
}

case $1 in
  install) install_and_move ;;
  command) run_command ;;
  without_module) run_without_module ;;
  find_package) use_find_package ;;
  pkg-config) use_pkg_config ;;
  compile_in_project) compile_in_project ;;
  add_subdirectory) use_add_subdirectory ;;
  debian) make_debian_packages ;;
  archive) make_archive ;;
  python) check_installed_python ;;
  wheel) make_wheel ;;
  core_alone) configure_core_alone ;;
  bash | zsh | fish) check_completions "$1" ;;
  *) fail "unknown task $1" ;;
esac
