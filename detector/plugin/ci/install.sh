#!/bin/sh
# Installs Assay in a CI job, in a container of Debian 12, as root. If a cache has the package in
# .package, this package is installed. If not, the package is built from the sources around this
# script, which takes some ten minutes.
set -e
sources=$(cd "$(dirname "$0")/../../.." && pwd)
ls .package/assay_*.deb >/dev/null 2>&1 || "$sources/reports/package/pack" --yes --out .package
apt-get update -qq
case ${DETECTOR-} in python:*) needs=python3-numpy ;; *) needs=g++ ;; esac
apt-get install -y -qq --no-install-recommends bubblewrap "$needs" ./.package/assay_*.deb
