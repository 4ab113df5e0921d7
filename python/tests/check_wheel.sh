#!/usr/bin/env bash
# Installs the package with pip, offline, into a fresh environment from a copy of the tree, takes
# the copy away and uses the package from another folder. What BUILD has compiled is not compiled
# again.
#   check_wheel.sh BUILD PYTHON
set -euo pipefail

build=$1 python=$2
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# No index, no cache: whatever pip wanted to fetch would fail.
export PIP_NO_INDEX=1 PIP_NO_CACHE_DIR=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH

mkdir "$work/tree"
cp -r "$source"/{pyproject.toml,CMakeLists.txt,LICENSE,docs,python} "$work/tree"
"$python" -m venv --system-site-packages "$work/env"
for copy in one two; do
  "$work/env/bin/python" -m pip wheel --quiet --no-deps --wheel-dir "$work/$copy" \
    --config-settings build-dir="$build" "$work/tree"
done
cmp "$work"/one/*.whl "$work"/two/*.whl
rm -rf "$work/two"
(cd "$work/tree" && "$work/env/bin/python" -m pip install --quiet \
  --config-settings build-dir="$build" .)
rm -rf "$work/tree"

cd "$work"
"$work/env/bin/python" "$source/tests/install/consumer.py" "$work/env"
# Nothing of the build is needed at run time.
module=$(find "$work/env" -name '_morsel*.so')
if readelf -d "$module" | grep -E 'RPATH|RUNPATH|libmorsel'; then exit 1; fi
"$work/env/bin/python" -m pip uninstall --quiet --yes morsel
