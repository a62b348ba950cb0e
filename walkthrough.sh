#!/usr/bin/env bash
# Installs what is missing, builds, and starts the walkthrough with the arguments given. See README.md.
# Without a display the program itself says so and draws to files.
set -eu
here=$(pwd)
root=$(cd "$(dirname "$0")" && pwd)
cd "$root"
. cmake/scripts/setup.sh
install_packages
build release manzana-walkthrough
cd "$here"
exec "$root/build/release/bin/manzana-walkthrough" "$@"
