# record_packages ROOT: records the packages that mmdebstrap has only extracted as dpkg does. Sourced by the hooks beside.
# Everything here writes below a root that mmdebstrap has just made, and stops at once if it is given anything else: an
# empty name would mean the running system.
set -euo pipefail

check_root() {
  [[ $# == 1 && $1 == /*/* && -d $1/var/cache/apt/archives && ! $1 -ef / && ! -s $1/var/lib/dpkg/status ]] ||
    { printf 'not a root that mmdebstrap has just extracted: "%s"\n' "${1:-}" >&2 && exit 1; }
}

record_packages() {
  check_root "$@"
  local database=$1/var/lib/dpkg package name
  mkdir -p "$database/info"
  for package in "$1"/var/cache/apt/archives/*.deb; do
    name=$(dpkg-deb -f "$package" Package)
    { dpkg-deb -f "$package" | sed 's/^Package: .*/&\nStatus: install ok installed/' && echo; } >>"$database/status"
    dpkg-deb --fsys-tarfile "$package" | tar -t | sed 's|^\./|/|; s|/$||; s|^$|/.|' >"$database/info/$name.list"
  done
}
