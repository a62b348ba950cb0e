#!/usr/bin/env bash
# Installs what is missing, builds, and starts the walkthrough with the arguments given. See README.md.
# Without a display the program itself says so and draws to files.
set -eu
from=$(pwd)
cd "$(dirname "$0")"
. cmake/scripts/setup.sh
start_program manzana-walkthrough "$from" "$@"
