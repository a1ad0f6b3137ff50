# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# For scripts that make a Debian of their own: sourced, not run. Needs root, debootstrap and the network.

# needs_debootstrap SCRIPT: ends the script with what is missing.
needs_debootstrap() {
  if [[ $(id -u) -ne 0 ]]; then
    echo "$1: needs to be root: debootstrap and chroot do" >&2
    exit 1
  fi
  if ! command -v debootstrap >/dev/null; then
    echo "$1: needs debootstrap (apt-get install debootstrap)" >&2
    exit 1
  fi
}

# The mirror that this machine's packages come from.
mirror_of_this_machine() {
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(REPO_URI)' | grep -v security | sort -u | head -n 1
}

# make_debian RELEASE FOLDER MIRROR: a minimal Debian in FOLDER/root, if it is not there yet.
make_debian() {
  if [[ -e $2/complete ]]; then
    echo "$2/root is there"
    return
  fi
  rm -rf --one-file-system "$2/root"
  debootstrap --variant=minbase "$1" "$2/root" "$3" >"$2/debootstrap.log" || {
    tail -n 20 "$2/debootstrap.log" >&2
    return 1
  }
  touch "$2/complete"
}

# inside OPTIONS COMMAND...: in $root, in mount and process namespaces of its own, and what else the options of unshare say.
# What is mounted and started there ends with it.
# shellcheck disable=SC2016,SC2086,SC2154
inside() {
  unshare --mount --pid --fork --kill-child $1 bash -c '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount --bind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/dev/shm"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    if [[ -z $(ip link show up dev lo) ]]; then ip link set lo up multicast on; fi  # in a network of its own
    exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
      CCACHE_DIR=/var/cache/ccache "$@"' _ "$root" "${@:2}"
}
