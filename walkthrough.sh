#!/usr/bin/env bash
# Installs what is missing, builds, and starts the walkthrough with the arguments given. See README.md.
set -eu
here=$(pwd)
root=$(cd "$(dirname "$0")" && pwd)
cd "$root"
. cmake/scripts/setup.sh
install_packages
build release manzana-walkthrough
cd "$here"
if [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  case " $* " in
    *" --headless "*|*" --help "*|*" -h "*|*" --version "*) ;;
    *) say "no display: drawing the tour to files instead (--headless)"; set -- "$@" --headless ;;
  esac
fi
exec "$root/build/release/bin/manzana-walkthrough" "$@"
