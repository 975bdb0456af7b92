#!/usr/bin/env bash
# Prints the Debian packages whose headers a build has compiled in, "NAME VERSION" a line: compiled_in.sh BUILD
set -euo pipefail
ninja -C "$1" -t deps | sed -n 's|^ \+\(/usr/.*\)|\1|p' | sort -u | xargs -r realpath | sort -u | xargs -r dpkg-query -S |
  sed 's/[:,].*//' | sort -u | xargs -r dpkg-query -W -f '${Package} ${Version}\n'
