#!/bin/sh
# bare_debian.sh SOURCES BUILD: installs the package by apt-get in a Debian 12 that holds nothing
# else, then tries every verb and the Python module.
set -eu
sources=$1 build=$2
here=$sources/tests/consumer/installed
# shellcheck source=tests/consumer/installed/bare.sh
. "$here/bare.sh"

mkdir -p "$bare/root/assay/mine"
(cd "$build" && cpack -G DEB -B "$bare/root/assay" >/dev/null)
rm -rf "$bare/root/assay/_CPack_Packages"
cp "$here/every_verb.sh" "$here/module.py" "$bare/root/assay"
cp "$build/tests/plugins/plugin_example.so" "$bare/root/assay/mine/libmine.so"
(cd "$bare/root/assay/mine" && "$build/record_example" >/dev/null)
ls -l "$bare"/root/assay/*.deb
chroot "$bare" sh -euc '
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq /root/assay/*.deb >/dev/null
  cd /root/assay
  sh every_verb.sh /usr/bin/assay /usr/share/assay /root/assay/mine whole
  cd mine
  python3 ../module.py /usr
  python3 -m assay --version'
