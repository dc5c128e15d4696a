#!/bin/sh
# pkg_config.sh PREFIX CXX CC FLAGS FOLDER: builds programs and a plug-in outside of this project
# with the flags that pkg-config gives for the detector installed in PREFIX, even if PREFIX was
# moved.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cxx=$2 cc=$3 flags=$4
rm -rf "$5" && mkdir -p "$5"
cp -R "$1" "$5/moved"
cd "$5"
files=$(dirname "$(find moved -name assay.pc)")
export PKG_CONFIG_PATH="$PWD/$files"

# shellcheck disable=SC2086,SC2046  # words
{
  "$cxx" -std=c++20 $flags "$here/consumer.cpp" $(pkg-config --cflags --libs assay) -o consumer_cpp
  "$cc" -std=c99 -c "$here/consumer.c" $(pkg-config --cflags assay) -o consumer_c.o
  "$cxx" $flags consumer_c.o $(pkg-config --libs assay) -o consumer_c
  "$cc" -std=c99 -shared -fPIC "$here/../plugins/example.c" $(pkg-config --cflags assay-plugin) -o example.so
}
./consumer_cpp
./consumer_c
version=$(pkg-config --modversion assay)
[ "$version" = "$(cat "$here/../../detector/VERSION")" ] || { echo "version $version" && exit 1; }
case $(pkg-config --cflags --libs assay-plugin) in
*eigen* | *tbb* | *-l*) echo "a plug-in needs the headers alone" && exit 1 ;;
esac
