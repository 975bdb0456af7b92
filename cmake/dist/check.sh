# Tries each file in dist/ as its users do: in roots of Debian that have nothing else, without a network. Sourced by
# bootstrap. Each check that fails is named at the end; the others are made.
source cmake/dist/dist.sh
here=$PWD/cmake/dist/check
scratch=$work/check
archive=dist/bdpt-$version-linux-x86_64.tar.xz

fail() {
  printf 'failed: %s\n' "$*" >&2
  exit 1
}

# check_root NAME SUITE PACKAGES: a fresh root with scenes in /scenes; prints its folder.
check_root() {
  make_root "$1" "$2" --variant=minbase ${3:+--include="$3"} >&2
  local root
  root=$(fresh_root "$1" "$scratch/$1")
  cp -r scenes "$root/scenes"
  mkdir -p "$root/out"
  echo "$root"
}

# A root with glibc alone: no shell, no libstdc++.
glibc_root() {
  make_root glibc bookworm --variant=extract --include=libc6
  local root
  root=$(fresh_root glibc "$scratch/glibc")
  cp -r scenes "$root/scenes"
  mkdir -p "$root/out"
  echo "$root"
}

# render_box ROOT PROGRAM OUT OPTIONS...: renders the Cornell box in a root; fails without an image.
render_box() {
  local root=$1 program=$2 out=$3
  shift 3
  rm -f "$root$out"
  in_root "$root" "$program" render /scenes/cornell-box.gltf --size 64x64 --spp 4 --quiet -o "$out" "$@"
  [[ -s $root$out ]] || fail "$program wrote no $out"
}

# unpack_archive ROOT [ARCHIVE]: to /bdpt
unpack_archive() {
  mkdir -p "$1/bdpt"
  tar -C "$1/bdpt" --strip-components=1 -xf "${2:-$archive}"
}

same_image() {
  local root=$1
  shift
  in_root "$root" /bdpt/bin/bdpt compare "$@" --threshold mse=0
}

check_sums() {
  (cd dist && sha256sum --check --strict SHA256SUMS)
}

check_bill() {
  rm -rf "$scratch/spdx"
  python3 -m venv "$scratch/spdx"
  "$scratch/spdx/bin/pip" install -q --no-index --find-links "$work/packages" spdx-tools
  "$scratch/spdx/bin/pyspdxtools" --infile "dist/bdpt-$version.spdx.json" --version SPDX-2.3
}

# The archive needs nothing but glibc, and renders the same image everywhere.
check_archive() {
  local root place
  for place in debian-12 debian-13 glibc; do
    case $place in
      debian-12) root=$(check_root debian-12 bookworm) ;;
      debian-13) root=$(check_root debian-13 trixie) ;;
      glibc) root=$(glibc_root) ;;
    esac
    unpack_archive "$root"
    in_root "$root" /bdpt/bin/bdpt --version
    render_box "$root" /bdpt/bin/bdpt /out/box.exr --isa sse2
    render_box "$root" /bdpt/bin/bdpt /out/smoke.png --volume /scenes/smoke.vdb
    [[ ! -d build/denoiser ]] || render_box "$root" /bdpt/bin/bdpt /out/clean.png --denoise
    cp "$root/out/box.exr" "$scratch/$place.exr"
    cp "$scratch/debian-12.exr" "$root/out/first.exr"
    same_image "$root" /out/box.exr /out/first.exr
  done
}

check_wheels() {
  local place suite root wheel
  for place in 12:bookworm:cp311 13:trixie:abi3; do
    IFS=: read -r place suite wheel <<<"$place"
    root=$(check_root "python-$place" "$suite" python3-venv)
    cp -r "$work/packages" "$here/wheel.py" "$root/"
    cp dist/bdpt-*"$wheel"*.whl "$root/packages/"
    in_root "$root" python3 -m venv /venv
    in_root "$root" /venv/bin/python /wheel.py "$version"
  done
}

# Installs, uses and removes the packages with Debian's mirror, since they need others of Debian's.
check_debian_packages() {
  local root
  root=$(check_root debian-12 bookworm)
  mkdir "$root/packages"
  cp dist/*.deb "$root/packages/"
  root_network=1 in_root "$root" bash /dev/stdin "$version" <"$here/debian.sh"
}

check_policy() {
  local root said
  root=$(check_root lintian bookworm lintian)
  cp dist/*.deb "$root/out/"
  said=$(in_root "$root" sh -c 'lintian --allow-root --tag-display-limit 0 /out/*.deb') || true
  printf '%s\n' "$said"
  ! grep -E '^(E|W):' <<<"$said" || fail "lintian has found errors or warnings"
}

# The image by its file system and its own configuration, as the user that it names.
check_image() {
  local bundle=$scratch/bundle layout=$scratch/layout bytes
  rm -rf "$bundle" "$layout"
  mkdir -p "$layout"
  tar -C "$layout" -xf "dist/bdpt-$version-oci-x86_64.tar"
  umoci unpack --image "$layout:$version" "$bundle"
  cp -r scenes "$bundle/rootfs/scenes"
  mkdir -p "$bundle/rootfs/proc"
  # The inner shell expands its own words.
  # shellcheck disable=SC2016
  unshare --mount --propagation private sh -c 'mount -t proc proc "$1/rootfs/proc" && exec python3 "$2" "$1" "$3"' sh \
    "$bundle" "$here/image.py" "$version"
  bytes=$(stat -c %s "dist/bdpt-$version-oci-x86_64.tar")
  [[ $bytes -le 100000000 ]] || fail "the image has $bytes bytes"
}

# The archive for aarch64 under qemu: the bits do not depend on the threads, and the image is that of x86-64.
check_aarch64() {
  local root=$work/root emulated="qemu-aarch64 -L /sysroot /arm/bin/bdpt" threads
  rm -rf "$root/arm" "$root/bdpt" "$root/scenes"
  mkdir -p "$root/arm" "$root/out"
  tar -C "$root/arm" --strip-components=1 -xf "dist/bdpt-$version-linux-aarch64.tar.xz"
  unpack_archive "$root"
  cp -r scenes "$root/scenes"
  # Words of a command.
  # shellcheck disable=SC2086
  in_root "$root" $emulated --version | grep -x "bdpt $version"
  for threads in 1 2; do
    # shellcheck disable=SC2086
    in_root "$root" $emulated render /scenes/cornell-box.gltf --size 64x64 --spp 16 --quiet --threads $threads -o "/out/arm-$threads.exr"
  done
  same_image "$root" /out/arm-1.exr /out/arm-2.exr
  in_root "$root" /bdpt/bin/bdpt render /scenes/cornell-box.gltf --size 64x64 --spp 16 --quiet -o /out/x86.exr
  # Much less than the noise: the same samples hit the same triangles, but for rounding.
  in_root "$root" /bdpt/bin/bdpt compare /out/arm-1.exr /out/x86.exr --threshold relmse=0.001
}

check_aarch64_wheels() {
  local place suite python root
  for place in bookworm:3.11 trixie:3.13; do
    IFS=: read -r suite python <<<"$place"
    root=$(check_root debian-12-qemu bookworm qemu-user)
    cp -r "$work/packages" "$here/wheel.py" "$root/"
    cp dist/bdpt-*aarch64.whl "$root/packages/"
    add_arm64_python "$root" "$suite" "$python"
    in_root "$root" "/opt/python-arm64-$python/venv/bin/python" /wheel.py "$version" "/opt/python-arm64-$python/run"
  done
}

# The unit tests of the core, built for aarch64 in the folder of the archive.
check_aarch64_tests() {
  in_root "$work/root" bash /dev/stdin /source "$(compile_jobs)" <"$here/aarch64_tests.sh"
}

# builds_in ROOT COMPILER: the source tarball builds there. It is not optimised, which takes a third of the time.
builds_in() {
  local root=$1 compiler=$2
  rm -rf "$root/unpacked"
  mkdir "$root/unpacked"
  tar -C "$root/unpacked" --strip-components=1 -xf "dist/bdpt-$version.tar.xz"
  in_root "$root" bash /dev/stdin /unpacked "$(compile_jobs)" "$version" "$compiler" <"$here/source.sh"
}

check_source() {
  builds_in "$work/root" g++
  local packages=("${build_packages[@]}" clang)
  make_root build-13 trixie --variant=essential --include="$(IFS=, && echo "${packages[*]}")"
  builds_in "$(fresh_root build-13 "$scratch/build-13")" clang++
}

# A second build of the commit, in another root and folder, makes the same bytes.
check_reproducible() {
  local root=$work/again file
  prepare_build_root "$root" /another/place
  add_newer_python "$root"
  export root_variables="SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)"
  in_root "$root" bash /another/place/cmake/dist/inside/linux.sh /another/place /out "$(compile_jobs)"
  in_root "$root" bash /another/place/cmake/dist/inside/wheels.sh /another/place /out "$(compile_jobs)" \
    /venv/bin/python /opt/python/usr/bin/python3.13
  for file in "$root"/out/*.{tar.xz,whl,zip,deb}; do
    cmp "$file" "dist/$(basename "$file")"
  done
}

# Old and small machines.
check_machines() {
  local root=$work/root isa
  rm -rf "$root/bdpt" "$root/scenes"
  mkdir -p "$root/out"
  unpack_archive "$root"
  cp -r scenes "$root/scenes"
  in_root "$root" bash /dev/stdin <"$here/machines.sh"
  # Without /proc the loader does not know where the program is, and needs to be told.
  export root_without_proc=1 root_variables=LD_ORIGIN_PATH=/bdpt/bin
  render_box "$root" /bdpt/bin/bdpt /out/no-proc.exr
}

check_all() {
  [[ -s dist/SHA256SUMS ]] || fail "there is no dist/SHA256SUMS: run ./bootstrap dist first"
  mkdir -p "$scratch"
  part "check of sums" check_sums
  part "check of the bill of materials" check_bill
  part "check of the archive" check_archive
  part "check of the wheels" check_wheels
  part "check of the image" check_image
  part "check of Debian packages" check_debian_packages
  part "check of Debian's policy" check_policy
  part "check of machines" check_machines
  part "check of aarch64" check_aarch64
  part "check of wheels for aarch64" check_aarch64_wheels
  part "check of aarch64 by unit tests" check_aarch64_tests
  part "check of the source tarball" check_source
  part "check that a second build is equal" check_reproducible
  if [[ ${#failed[@]} -gt 0 ]]; then
    printf 'bootstrap: not passed: %s\n' "${failed[@]}" >&2
    exit 1
  fi
  say "all checks passed"
}
