#!/usr/bin/env bash
# Checks everything: format, lints, documentation, doctests, tests. Stops at the first failure.
#
#   ./test.sh           all of it
#   ./test.sh --quick   format, lints and the unit tests beside the code
#   ./test.sh --consumers
#                       all of it, and opens written files with VTK, PyVista and Gmsh too. Once the project writes USD, usd-core
#                       belongs to these.
#
# Needs Rust (rustup; rust-toolchain.toml names the version) and a C compiler. The exact oracles of the tests build GMP,
# which needs m4 and make; written files are read with meshio, which needs Python 3.10 or later with venv and pip. These are
# installed where that is possible without a question, else named. Python packages go to target/venv alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

quick=no
consumers=no
for argument in "$@"; do
    case "$argument" in
        --quick) quick=yes ;;
        --consumers) consumers=yes ;;
        -h | --help)
            sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' test.sh
            exit 0
            ;;
        *)
            echo "test.sh: unknown argument '$argument'; try --help" >&2
            exit 2
            ;;
    esac
done

die() {
    echo "test.sh: $*" >&2
    exit 1
}

have() {
    command -v "$1" > /dev/null 2>&1
}

# Runs a command as root, without asking for a password.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif have sudo && sudo -n true 2> /dev/null; then
        sudo -n "$@"
    else
        return 1
    fi
}

# Installs packages with whichever package manager there is.
install_packages() {
    if have apt-get; then
        as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q &&
            as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@"
    elif have dnf; then
        as_root dnf install -q -y "$@"
    elif have apk; then
        as_root apk add -q "$@"
    elif have pacman; then
        as_root pacman -S --noconfirm --needed "$@"
    elif have brew; then
        brew install -q "$@"
    else
        return 1
    fi
}

require_tools() {
    if ! have cargo && [ -f "${CARGO_HOME:-$HOME/.cargo}/env" ]; then
        # shellcheck disable=SC1091
        . "${CARGO_HOME:-$HOME/.cargo}/env"
    fi
    have cargo || die "cargo is missing: install Rust from https://rustup.rs, then run this again"
    have cc || have gcc || have clang ||
        die "a C compiler is missing: apt-get install gcc libc6-dev, dnf install gcc, apk add build-base, xcode-select --install"
    local missing=()
    have m4 || missing+=(m4)
    have make || missing+=(make)
    if [ "${#missing[@]}" -gt 0 ]; then
        echo "== installing ${missing[*]} (GMP, which the exact oracles of the tests use, is built with them)"
        install_packages "${missing[@]}" ||
            die "install ${missing[*]} first: apt-get install ${missing[*]}, dnf install ${missing[*]}, apk add ${missing[*]} or brew install ${missing[*]}"
    fi
    cargo fmt --version > /dev/null 2>&1 || die "rustfmt is missing: rustup component add rustfmt"
    cargo clippy --version > /dev/null 2>&1 || die "clippy is missing: rustup component add clippy"
}

# Makes a Python environment under target/ with the packages that a file lists, unless it is there already.
python_environment() {
    local folder="target/$1" list="tests/consumers/$2"
    if [ -x "$folder/bin/python" ] && cmp -s "$list" "$folder/installed.txt"; then
        return
    fi
    echo "== installing the Python packages of $list into $folder"
    if ! have python3 || ! python3 -c 'import ensurepip, venv' 2> /dev/null; then
        install_packages python3 python3-venv || install_packages python3 ||
            die "Python with venv is missing: apt-get install python3 python3-venv, dnf install python3, apk add python3 or brew install python"
    fi
    rm -rf "$folder"
    python3 -m venv "$folder" ||
        die "python3 -m venv fails: apt-get install python3-venv, or any Python of 3.10 or later with venv and pip"
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$list" ||
        die "pip cannot install the packages of $list (is there a network?): do it by hand, $folder/bin/python -m pip install -r $list && cp $list $folder/installed.txt"
    cp "$list" "$folder/installed.txt"
}

# Runs one stage, and prints how long it took or that it failed.
stage() {
    local name="$1" started="$SECONDS"
    shift
    echo "== $name: $*"
    if ! "$@"; then
        echo "test.sh: stage '$name' FAILED after $((SECONDS - started)) s: $*" >&2
        exit 1
    fi
    echo "== $name: passed in $((SECONDS - started)) s"
}

require_tools
stage style cargo style
stage lint cargo lint
if [ "$quick" = yes ]; then
    stage unit cargo test --workspace --all-features --lib --bins
else
    stage docs env RUSTDOCFLAGS="-D warnings" cargo docs
    stage doctest cargo doctest
    python_environment venv requirements.txt
    export WELTER_MESHIO_PYTHON_REQUIRED=1
    if [ "$consumers" = yes ]; then
        python_environment venv-consumers requirements-all.txt
        export WELTER_CONSUMERS_PYTHON_REQUIRED=1
    fi
    stage unit cargo unit
fi
