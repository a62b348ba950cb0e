# Sourced by the scripts of the README: installs what packages.txt names and this machine lacks, configures, builds.
# install_packages FILE...: of other lists as well
say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

install_packages() {
  local missing
  missing=$(cat packages.txt "$@" | sed 's/#.*//' | xargs -r dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' 2>&1 |
    awk '/no packages found matching/ {print $NF; next} $1 != "ii" && $1 != "hi" {print $2}' | sed 's/:.*//')
  [ -z "$missing" ] && return
  say "installing:" $missing
  local root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "these Debian packages are missing, and there is no sudo to install them: $missing" >&2; exit 1; }
    root=sudo
  fi
  $root apt-get update -q
  $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing
}

# build PRESET [TARGET...]
build() {
  local preset=$1; shift
  [ -f "build/$preset/build.ninja" ] || { say "configuring ($preset)"; cmake --preset "$preset" >&2; }
  say "building ($preset)"
  cmake --build --preset "$preset" ${*:+--target "$@"} >&2
}

# start_program PROGRAM FOLDER [ARGUMENT...]: in that folder, so that arguments may name files relative to it
start_program() {
  local program=$1 from=$2 root; root=$(pwd); shift 2
  install_packages
  build release "$program"
  cd "$from"
  exec "$root/build/release/bin/$program" "$@"
}
