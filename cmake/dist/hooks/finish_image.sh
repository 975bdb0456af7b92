#!/usr/bin/env bash
# Finishes the small system of the container image, which has a shell: finish_image.sh ROOT
source "$(dirname "${BASH_SOURCE[0]}")/record_packages.sh"
record_packages "$@"
root=$1
find "$root/usr/share/doc" -type f ! -name copyright -delete
rm -r "$root/usr/share/man" "$root/usr/share/locale" "$root/usr/lib/x86_64-linux-gnu/gconv"
printf '%s\n' root:x:0:0:root:/root:/bin/bash bdpt:x:1000:1000::/data:/bin/bash >"$root/etc/passwd"
printf '%s\n' root:x:0: bdpt:x:1000: >"$root/etc/group"
