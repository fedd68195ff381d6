#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""cpack makes a Debian package that names what it depends on; what it has runs from wherever it is unpacked."""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--build", type=pathlib.Path, required=True, help="build folder of Taut")
arguments = parser.parse_args()
for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file"):
    if not shutil.which(tool):
        print(f"skipped: there is no {tool}")
        sys.exit(77)


def said(*command, **options):
    done = subprocess.run(command, text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stdout}{done.stderr}")
    return done.stdout


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    said("cpack", "-G", "DEB", "-B", folder, cwd=arguments.build)
    package, = folder.glob("taut_*.deb")
    about = said("dpkg-deb", "-f", package)
    for part in ("Package: taut", "libdeal.ii", "libtrilinos"):
        if part not in about:
            sys.exit(f"'{part}' is not in\n{about}")
    said("dpkg-deb", "-x", package, folder / "unpacked")
    program, = (folder / "unpacked").rglob("bin/taut")
    if not re.match(r"taut \d", said(program, "--version")):
        sys.exit(said(program, "--version"))
    scene, = (folder / "unpacked").rglob("guyed_mast.prm")
    log = said(program, scene, "--set", f"Output/Folder={folder}/results", "--set", "Time/End=0.1")
    if "Certificate: " not in log:
        sys.exit(log)
    for file in ("cmake/taut/tautConfig.cmake", "include/taut/time/stepper.h", "bin/taut-plot"):
        if not list((folder / "unpacked").rglob(file)):
            sys.exit(f"the package has no {file}")
