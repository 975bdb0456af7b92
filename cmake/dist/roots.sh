# Roots of Debian, made by mmdebstrap: those that a release is built in, and those that it is tried in. Sourced by the
# other scripts of this folder. The system's own packages stay as they are.

# Where they are kept: packed ones, and those in use.
roots=$PWD/build/dist/roots

# Prints the mirror of this system; without apt, Debian's.
debian_mirror() {
  local mirror
  mirror=$({ cat /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null || true; } |
    sed -n 's/^URIs: *//p; s/^deb  *\(\[[^]]*\] *\)\{0,1\}\(http[^ ]*\).*/\2/p' | sed -n 1p)
  echo "${mirror:-http://deb.debian.org/debian}"
}

# debian_sources SUITE: prints the lines of apt for a suite, with its updates.
debian_sources() {
  local mirror
  mirror=$(debian_mirror)
  printf 'deb %s %s main\n' "$mirror" "$1" "$mirror" "$1-updates" "${mirror%/debian}/debian-security" "$1-security"
}

# make_root NAME SUITE OPTIONS...: packs a root, unless it is there.
make_root() {
  local name=$1 suite=$2
  shift 2
  [[ ! -s $roots/$name.tar ]] || return 0
  say "making a root of Debian: $name"
  mkdir -p "$roots"
  if ! debian_sources "$suite" | mmdebstrap --mode=root "$@" "$suite" "$roots/$name.part.tar" - >"$roots/$name.log" 2>&1; then
    tail -n 5 "$roots/$name.log" >&2
    return 1
  fi
  mv "$roots/$name.part.tar" "$roots/$name.tar"
}

# fresh_root NAME [FOLDER]: unpacks a packed root and prints the folder.
fresh_root() {
  local folder=${2:-$roots/$1}
  rm -rf --one-file-system "$folder"
  mkdir -p "$folder"
  tar -C "$folder" -xf "$roots/$1.tar"
  chmod 755 "$folder"
  echo "$folder"
}

# in_root ROOT COMMAND...: runs it in the root, with nothing of the caller's environment but what root_variables names
# (NAME=VALUE ...), as root_user (UID:GID; root). With root_network=1 it has the caller's network, else none; with
# root_without_proc=1 there is no /proc. Mounts vanish with it.
in_root() {
  local root=$1 network=(--net)
  shift
  if [[ ${root_network:-} == 1 ]]; then
    network=()
    cp -L /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
  fi
  # The inner shell expands its own words; root_variables is split into words.
  # shellcheck disable=SC2016,SC2086
  unshare --mount --pid --fork --propagation private "${network[@]}" bash -c '
    root=$1
    shift
    [[ ${root_network:-} == 1 ]] || ip link set lo up  # a view listens on it
    mkdir -p "$root/proc" "$root/dev" "$root/tmp"
    [[ ${root_without_proc:-} == 1 ]] || mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    exec env -i HOME=/root PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb \
      ${root_variables:-} chroot ${root_user:+--userspec=$root_user} "$root" "$@"' bash "$root" "$@"
}
