#!/usr/bin/env bash
# Installs what is missing, builds, and starts the culling benchmark with the arguments given. See README.md.
set -eu
here=$(pwd)
root=$(cd "$(dirname "$0")" && pwd)
cd "$root"
. cmake/scripts/setup.sh
install_packages
build release manzana-culling-benchmark
cd "$here"
exec "$root/build/release/bin/manzana-culling-benchmark" "$@"
