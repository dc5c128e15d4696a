#!/bin/sh
# bare_debian.sh SOURCES BUILD: the package in a Debian 12 that holds nothing else: installed by its
# own apt-get, and asked for every verb and the Python module. Wants root, debootstrap and a mirror;
# 77: one of them is not here. ASSAY_BARE names a folder in which the bare system is kept.
set -eu
sources=$1 build=$2
here=$sources/tests/consumer/installed
mirror=${ASSAY_MIRROR:-http://deb.debian.org/debian}
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "root and debootstrap are wanted"
  exit 77
fi
kept=${ASSAY_BARE:-}
bare=${kept:-$(mktemp -d)}
cleanup() {
  for place in proc dev sys; do umount -Rlq "$bare/$place" || true; done
  [ -n "$kept" ] || rm -rf --one-file-system "$bare"
}
trap cleanup EXIT

if [ ! -e "$bare/usr/bin/apt-get" ]; then
  debootstrap --variant=minbase bookworm "$bare" "$mirror" >/dev/null || {
    echo "no bare Debian is to be had from $mirror"
    exit 77
  }
fi
for place in proc dev sys; do mount --rbind --make-rslave "/$place" "$bare/$place"; done
cp /etc/resolv.conf "$bare/etc/resolv.conf"

rm -rf "$bare/root/assay" && mkdir -p "$bare/root/assay/mine"
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
