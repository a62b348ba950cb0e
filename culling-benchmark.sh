#!/usr/bin/env bash
# Installs what is missing, builds, and starts the culling benchmark with the arguments given. See README.md.
set -eu
from=$(pwd)
cd "$(dirname "$0")"
. cmake/scripts/setup.sh
start_program manzana-culling-benchmark "$from" "$@"
