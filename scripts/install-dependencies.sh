#!/usr/bin/env bash
# Installs the Debian 12 packages that morsel needs and this machine lacks. Instant and offline
# when nothing is missing.
#   scripts/install-dependencies.sh          what building, the tests and the demo need
#   scripts/install-dependencies.sh --lint   also what `make lint` needs
#   scripts/install-dependencies.sh --python also what the Python package needs
#   scripts/install-dependencies.sh --docs   also what `make docs` needs
#   scripts/install-dependencies.sh --fuzz   also what `make fuzz` needs
#   scripts/install-dependencies.sh --clean-root    also what scripts/clean-root.sh needs
#   scripts/install-dependencies.sh --test   also what `make test` needs
#   scripts/install-dependencies.sh --peers  also what `morsel-bench peers` compares with: hundreds
#   scripts/install-dependencies.sh --dev    also what every other target needs
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache pkg-config python3
  libcgal-dev libeigen3-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev
  liblzf-dev libnanoflann-dev zlib1g-dev libsqlite3-dev libsqlitecpp-dev libpq-dev libxxhash-dev
  libcpp-httplib-dev libgtest-dev
)
# Node.js builds the viewer; one that did not come from Debian brings its npm along.
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then packages+=(nodejs npm); fi
lint=(clang-format clang-tidy-16 shellcheck) # 14, the default, cannot parse <ranges>
docs=(doxygen mkdocs)
fuzz=(clang-16 libclang-rt-16-dev llvm-16)
clean_root=(mmdebstrap)
python=(pybind11-dev python3-dev python3-numpy python3-pip python3-venv)
test=("${lint[@]}" chromium "${python[@]}" python3-scipy python3-pytest python3-jsonschema mypy
  python3-matplotlib python3-plotly "${docs[@]}" wrk postgresql slurm-wlm munge)
peers=(libpcl-dev libfaiss-dev python3-gudhi python3-scipy)
case "${1:-}" in
  "") ;;
  --lint) packages+=("${lint[@]}") ;;
  --python) packages+=("${python[@]}") ;;
  --docs) packages+=("${docs[@]}") ;;
  --fuzz) packages+=("${fuzz[@]}") ;;
  --clean-root) packages+=("${clean_root[@]}") ;;
  --test) packages+=("${test[@]}") ;;
  --peers) packages+=("${peers[@]}") ;;
  --dev) packages+=("${test[@]}" "${fuzz[@]}" "${clean_root[@]}") ;;
  *)
    echo "usage: $0 [--lint|--python|--docs|--fuzz|--clean-root|--test|--peers|--dev]" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "$0: needs Debian 12 or a relative of it; elsewhere install these by hand:" >&2
  echo "  ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null) || true
  grep -qx installed <<<"$status" || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "$0: not root and no sudo; have an administrator run:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  root=(sudo)
fi

install() {
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --quiet --no-install-recommends "${missing[@]}"
}

echo "Installing Debian packages: ${missing[*]}"
# The package lists are brought up to date only when those at hand are absent or too old.
install || { "${root[@]}" apt-get update --quiet && install; }
