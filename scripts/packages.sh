# Sourced by the other scripts: the Debian packages that shadebench needs, and their
# installation. One list a purpose. g++: for libstdc++, which glslang is linked with.

packages_build="gcc g++ libc6-dev cmake ninja-build pkg-config libyaml-dev libjansson-dev
    libpng-dev glslang-dev libspirv-cross-c-shared-dev python3-glad libegl-dev libosmesa6-dev
    libglfw3-dev valgrind"
packages_run="libegl1 libgl1-mesa-dri libosmesa6 libglfw3 mesa-vulkan-drivers glslang-tools
    valgrind"
packages_test="libcmocka-dev libmpfr-dev clang-format clang-tidy xvfb xauth
    libxml2-utils libbenchmark-tools"

# install_missing PACKAGE...: installs what is not there, and says what; without root or sudo,
# or where this is no Debian, says exactly what to type.
install_missing() {
    missing=""
    if ! command -v dpkg-query >/dev/null; then
        echo "This is no Debian system, so nothing is installed. Needed are the equivalents of:"
        echo "   " $*
        return 0
    fi
    for package in $*; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
            missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    if [ "$(id -u)" = 0 ]; then
        as_root=""
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        as_root="sudo"
    elif command -v sudo >/dev/null && [ -t 0 ]; then
        as_root="sudo"
    else
        echo "These packages are missing, and installing them needs root. Run this, then again:" >&2
        echo "    apt-get update && apt-get install --no-install-recommends$missing" >&2
        exit 2
    fi
    echo "Installing:$missing"
    export DEBIAN_FRONTEND=noninteractive
    log=$(mktemp)
    if ! { $as_root apt-get update && $as_root apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
        tail -n 5 "$log" >&2
        echo "apt-get failed; its output is in $log. Needed are:$missing" >&2
        exit 2
    fi
    rm -f "$log"
}

# build PRESET [CMAKE ARGUMENT...]: configures and builds, quietly unless it fails: all, or $target.
target=""
build() {
    preset=$1
    shift
    log=$(mktemp)
    if ! { cmake --preset "$preset" "$@" &&
        cmake --build --preset "$preset" ${target:+--target "$target"}; } >"$log" 2>&1; then
        cat "$log" >&2
        rm -f "$log"
        echo "building preset $preset failed" >&2
        exit 2
    fi
    rm -f "$log"
}
