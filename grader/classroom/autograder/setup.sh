#!/usr/bin/env bash
# Builds Gradescope's image, once: Python 3.11 or newer, and the packages that grading needs.
set -euo pipefail
root="${AUTOGRADER_ROOT:-/autograder}"

find_python() {
  for name in python3.13 python3.12 python3.11 python3; do
    if "$name" -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
      echo "$name"
      return
    fi
  done
  return 1
}

if ! python="$(find_python)"; then
  apt-get update
  apt-get install -y python3.11 python3.11-venv || apt-get install -y python3 python3-venv
  python="$(find_python)"
fi
"$python" -m venv "$root/environment"
pip="$root/environment/bin/pip"
"$pip" install --no-cache-dir -r "$root/source/requirements.txt"
"$pip" install --no-cache-dir -r "$root/source/requirements-robot.txt" ||
  echo "RobotPy could not be installed: Python robot code is read, and not run."
cd "$root/source/course"
"$root/environment/bin/python" -c 'from sim.physics.engine import load_engine; load_engine()' # compiles the simulation
