#!/usr/bin/env bash
# Installs what is missing, checks the formatting, builds and runs every test.  ./test.sh [release|debug|asan]
set -eu
cd "$(dirname "$0")"
preset=${1:-release}
. cmake/scripts/setup.sh
install_packages packages-test.txt
if [ -z "${MANZANA_DATA:-}" ] && [ -d ../shared/data ]; then
  MANZANA_DATA=$(cd ../shared/data && pwd)
  export MANZANA_DATA
fi
say "checking the formatting"
git ls-files '*.cpp' '*.h' | xargs -r clang-format --dry-run -Werror
build "$preset"
say "testing ($preset)"
ctest --preset "$preset" -j "$(nproc)"
