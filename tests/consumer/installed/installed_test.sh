#!/bin/sh
# installed_test.sh SOURCES BUILD: installs what is built, then hides sources and build, and tries
# every verb. Then makes a Debian package of the same files and checks its content.
set -eu
sources=$1 build=$2
here=$sources/tests/consumer/installed
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
  echo "$*"
  exit 1
}

cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/log" || fail "$(cat "$scratch/log")"
cd "$scratch/prefix"
for file in bin/assay libexec/assay/assay-worker share/assay/corpus/curated/D6_fast_passage.json \
  share/assay/schemas/certificate.schema.json share/doc/assay/LICENSE share/doc/assay/THIRD_PARTY \
  include/assay/detector/detector.h include/assay/detector/plugin/assay_detector.h; do
  [ -f "$file" ] || fail "$file is not installed"
done
if [ -d "$build/python/assay" ]; then
  ls lib/python3*/dist-packages/assay/__init__.py >/dev/null || fail "the Python module is not installed"
fi
# The program and each verb have a man page, which formatters accept without a warning.
if command -v help2man >/dev/null; then
  verbs=$(bin/assay help | sed -n 's/^  \([a-z][a-z-]*\) .*/assay-\1/p')
  for page in assay $(echo "$verbs" | grep -vx -e assay-help -e assay-version); do
    page=share/man/man1/$page.1
    [ -f "$page" ] || fail "$page is not installed"
    grep -q '^[.]B assay$' "$page" || fail "$page has no synopsis"
    warned=$(command -v groff >/dev/null && groff -man -Tutf8 -ww -z "$page" 2>&1) || true
    [ -z "$warned" ] || fail "$page: $warned"
  done
  grep -q '^.fB.-.-culling' share/man/man1/assay-check.1 || fail "assay-check.1 lacks an option"
fi
mkdir "$scratch/few"
ln -s "$(command -v rm)" "$scratch/few"
(PATH=$scratch/few /bin/bash "$sources/reports/package/man_pages" "$scratch/few" "$scratch/few") |
  grep -qx "no man pages: help2man is not installed" || fail "that there are no pages is not said"
if found=$(grep -rlF -e "$sources/" -e "$build/" .); then
  fail "paths of the machine that built it are in: $found"
fi

# Programs that the tests build make the input of the verbs.
mkdir "$scratch/mine"
cp "$build/tests/plugins/plugin_example.so" "$scratch/mine/libmine.so"
cp "$here/every_verb.sh" "$here/module.py" "$scratch"
(cd "$scratch/mine" && "$build/record_example" >/dev/null)
cat >"$scratch/all.sh" <<'ALL'
set -eu
[ "$1" = none ] || mount -t tmpfs none "$1"
cd "$2"
sh every_verb.sh "$2/prefix/bin/assay" "$2/prefix/share/assay" "$2/mine"
for package in prefix/lib/python3*/dist-packages; do
  [ ! -d "$package" ] || (cd mine && PYTHONPATH="$2/$package" /usr/bin/python3 "$2/module.py" "$2/prefix")
done
ALL
# Without user namespaces the sources cannot be hidden. Then it is only checked that none of their
# paths occurs.
if unshare --user --map-root-user --mount true 2>/dev/null; then
  unshare --user --map-root-user --mount sh "$scratch/all.sh" "$sources" "$scratch"
else
  echo "no user namespaces here: the sources stay in sight"
  sh "$scratch/all.sh" none "$scratch"
fi

if ! command -v dpkg-shlibdeps >/dev/null || ! command -v file >/dev/null; then
  echo "no package is made: dpkg-dev and file are not installed"
  exit 0
fi
cd "$build"
cpack -G DEB -B "$scratch/packed" >"$scratch/log" 2>&1 || fail "$(cat "$scratch/log")"
package=$(ls "$scratch"/packed/*.deb)
[ "$(dpkg-deb -f "$package" Version)" = "$(cat "$sources/detector/VERSION")" ] || fail "another version"
dpkg-deb -f "$package" Depends | grep -q "libgmp10.*libmpfr6.*libseccomp2" || fail "no dependencies"
dpkg-deb -x "$package" "$scratch/root"
(cd "$scratch/root/usr" && find . -type f | sort) >"$scratch/packed.list"
(cd "$scratch/prefix" && find . -type f | sort) >"$scratch/installed.list"
diff "$scratch/installed.list" "$scratch/packed.list" || fail "the package holds other files"
"$scratch/root/usr/bin/assay" check \
  "$scratch/root/usr/share/assay/corpus/curated/B1_one_vertex_own_nearest.json" >/dev/null
