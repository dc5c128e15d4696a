# Sourced: makes a bare Debian 12 in the folder $bare, which is removed afterwards. It needs root,
# debootstrap and a mirror, and ends with 77 if one of them is missing. If ASSAY_BARE names a
# folder, the bare system stays there.
# shellcheck shell=sh
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
rm -rf "$bare/root/assay"
