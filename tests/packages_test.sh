#!/usr/bin/env bash
# Tests the progress of a build and its result (packages.sh), with a script in place of cmake.
set -euo pipefail
packages=$(cd "$(dirname "$0")" && pwd)/packages.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
failed=0

cat >cmake <<'FAKE'
#!/usr/bin/env bash
[ "$1" = --preset ] && exit 0
echo "[1/7] Building a.cpp"
sleep 2.2
echo "[5/7] Building b.cpp"
sleep 1.2
echo "error: b.cpp is wrong"
exit "${FAKE_CODE:-0}"
FAKE
chmod +x cmake
export PATH=$PWD:$PATH

expect() { # WHAT PATTERN TEXT
  if grep -qE -- "$2" <<<"$3"; then echo "ok: $1"; else
    printf 'FAILED: %s: no "%s" in:\n%s\n' "$1" "$2" "$3"
    failed=1
  fi
}

# This runs in a subshell, so that the sourced functions exist only there.
build() {
  (
    set -e
    # shellcheck source=packages.sh
    . "$packages"
    build_preset some all
  )
}

printed=$(build)
expect "a build that is done says so" '^built in [3-9] s$' "$printed"
expect "its log has all lines" '5/7' "$(cat build/some.log)"
code=0
printed=$(FAKE_CODE=1 build 2>&1) || code=$?
[ "$code" -eq 1 ] || { echo "FAILED: a build that fails ends with $code" && failed=1; }
expect "one that fails shows its errors" '^error: b.cpp is wrong$' "$printed"
expect "and its log" '^the build failed; see build/some.log$' "$printed"

# shellcheck source=packages.sh
printed=$(. "$packages" && cmake --build | show_build 1)
expect "elsewhere lines are added" '^  1 of 7 steps, [12] s$' "$printed"
expect "one after the other" '^  5 of 7 steps, [2-4] s$' "$printed"
printed=$(script -qec "bash -c '. $packages; cmake --build | show_build 30'" /dev/null)
expect "on a terminal one is rewritten" $'\r\033\\[K  1 of 7 steps, [12] s' "$printed"
exit $failed
