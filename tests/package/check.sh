#!/usr/bin/env bash
# Installs a package of wrinkle in a bare Debian and tries it there: check.sh FILE.deb. As root; takes a few minutes.
set -euo pipefail
package=$(realpath "$1")
data=$(realpath "$(dirname "$0")/../../data")
root=$(mktemp -d)
trap 'umount "$root/proc" "$root/sys" "$root/dev" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT

mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | head -1)
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail -20 "$root.log"; exit 1; }
rm -f "$root.log"
mount -t proc proc "$root/proc"
mount --bind /sys "$root/sys"
mount --bind /dev "$root/dev"
[ ! -d /etc/apt/apt.conf.d ] || cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
cp "$package" "$root/tmp/wrinkle.deb"
cp -r "$data" "$root/tmp/data"
in_it() { chroot "$root" env DEBIAN_FRONTEND=noninteractive "$@"; }
in_it apt-get update -qq
in_it apt-get install -y -qq --no-install-recommends /tmp/wrinkle.deb >/dev/null
in_it wrinkle version
in_it wrinkle devices
in_it wrinkle run /tmp/data/scenes/constant.toml -o /tmp/out >/dev/null
for file in /tmp/out/normal.exr /usr/share/man/man1/wrinkle-run.1.gz /usr/share/bash-completion/completions/wrinkle \
            /usr/share/wrinkle/kernels/README.md /usr/include/wrinkle/passes.h; do
    [ -s "$root$file" ] || [ -s "$root${file%.gz}" ] || { echo "the package lacks $file" >&2; exit 1; }
done
in_it apt-get remove -y -qq wrinkle >/dev/null
[ ! -e "$root/usr/bin/wrinkle" ] || { echo "removing the package leaves the program" >&2; exit 1; }
echo "installs, runs and removes in a bare Debian"
