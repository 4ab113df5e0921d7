"""Makes the wheel: CMake builds the package, its files go into a zip archive (PEP 517, PEP 427).

Needs Python's standard library alone, so that pip has nothing to download. The same tree and
compiler give the same bytes. Settings (pip install . --config-settings KEY=VALUE):

    build-dir=DIR   a build folder of CMake to use and keep; default build/wheel-<python>
    viewer=on|off   whether the pages of show() and to_html() are built; default: where npm can
"""

import base64
import csv
import email.message
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TAG = f"cp{sys.version_info[0]}{sys.version_info[1]}"
PLATFORM = sysconfig.get_platform().replace("-", "_").replace(".", "_")
DATE = (1980, 1, 1, 0, 0, 0)  # of all files in the wheel


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / dist_info()
    folder.mkdir()
    (folder / "METADATA").write_bytes(metadata())
    (folder / "WHEEL").write_bytes(wheel_file())
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    name = f"morsel-{version()}-{TAG}-{TAG}-{PLATFORM}.whl"
    build = pathlib.Path(settings.get("build-dir", ROOT / "build" / f"wheel-{TAG}")).absolute()
    with tempfile.TemporaryDirectory() as staged:
        compile_package(build, settings, pathlib.Path(staged))
        files = {path.relative_to(staged).as_posix(): path.read_bytes()
                 for path in pathlib.Path(staged).rglob("*") if path.is_file()}
    files[f"{dist_info()}/METADATA"] = metadata()
    files[f"{dist_info()}/WHEEL"] = wheel_file()
    files[f"{dist_info()}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    write_wheel(pathlib.Path(wheel_directory) / name, files)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("morsel is built from its repository; `git archive` packs the sources")


def compile_package(build, settings, staged):
    if "build-dir" not in settings or not (build / "CMakeCache.txt").exists():
        run("cmake", "-S", ROOT, "-B", build, *generator(), "-DCMAKE_BUILD_TYPE=Release",
            "-DBUILD_SHARED_LIBS=OFF", "-DMORSEL_BUILD_APPS=OFF", "-DMORSEL_BUILD_TESTS=OFF",
            "-DMORSEL_BUILD_PYTHON=ON", f"-DMORSEL_PYTHON={sys.executable}",
            f"-DMORSEL_BUILD_VIEWER={'ON' if viewer(settings) else 'OFF'}")
    run("cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", "morsel_python")
    run("cmake", "--install", build, "--component", "python", "--prefix", staged)
    module = "_morsel" + sysconfig.get_config_var("EXT_SUFFIX")
    if not (staged / "morsel" / module).exists():
        raise RuntimeError(f"{build} is configured for another Python; it made no {module}")


def generator():
    return ["-G", "Ninja"] if shutil.which("ninja") else []


def viewer(settings):
    """Whether npm has, or can fetch, what the viewer is built from."""
    choice = settings.get("viewer", "auto")
    if choice != "auto":
        return choice == "on"
    if not shutil.which("npm"):
        return False
    if (ROOT / "web" / "node_modules" / ".package-lock.json").exists():
        return True
    fetch = subprocess.run(
        ["npm", "ci", "--prefer-offline", "--fetch-retries=0", "--no-audit", "--no-fund"],
        cwd=ROOT / "web", check=False)
    if fetch.returncode != 0:
        print("npm cannot fetch its packages: built without the viewer of show() and to_html()")
    return fetch.returncode == 0


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(morsel VERSION ([0-9.]+)", text).group(1)


def dist_info():
    return f"morsel-{version()}.dist-info"


def metadata():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    message = email.message.Message()
    message["Metadata-Version"] = "2.1"
    message["Name"] = project["name"]
    message["Version"] = version()
    message["Summary"] = project["description"]
    message["License"] = project["license"]["text"]
    message["Requires-Python"] = project["requires-python"]
    for package in project["dependencies"]:
        message["Requires-Dist"] = package
    message["Description-Content-Type"] = "text/markdown"
    message.set_payload((ROOT / project["readme"]).read_bytes())
    return message.as_bytes()


def wheel_file():
    return (f"Wheel-Version: 1.0\nGenerator: morsel {version()}\nRoot-Is-Purelib: false\n"
            f"Tag: {TAG}-{TAG}-{PLATFORM}\n").encode()


def record(files, name):
    """The table of all files with their hashes; its own row has none."""
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    for path, content in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        rows.writerow([path, f"sha256={digest}", len(content)])
    rows.writerow([name, "", ""])
    return table.getvalue().encode()


def write_wheel(path, files):
    name = f"{dist_info()}/RECORD"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for file, content in [*sorted(files.items()), (name, record(files, name))]:
            entry = zipfile.ZipInfo(file, DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if file.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, content)
