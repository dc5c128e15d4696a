#!/bin/sh
# bare_doors.sh SOURCES: follows the page alone, from a clone in a bare Debian 12 to the gates of a
# detector in C++, a detector in Python and a recorded log, build included.
set -eu
sources=$1
# shellcheck source=tests/consumer/installed/bare.sh
. "$sources/tests/consumer/installed/bare.sh"
git clone -q "$sources" "$bare/root/assay"
python3 "$sources/tests/readme/doors.py" --chroot "$bare" --at /root/assay
