#!/usr/bin/env bash
# Finishes a root of libraries for another processor, which will be used as /sysroot: finish_sysroot.sh ROOT
source "$(dirname "${BASH_SOURCE[0]}")/record_packages.sh"
record_packages "$@"
root=$1
find "$root" -type l -lname '/*' ! -path "$root/dev/*" | while read -r link; do
  ln -sfr "$root$(readlink "$link")" "$link"
done
# Draco's package names its files by their absolute paths.
sed -i 's|"/usr/|"/sysroot/usr/|g; s|;/usr/|;/sysroot/usr/|g' "$root"/usr/lib/*/cmake/draco/*.cmake
