#!/bin/sh
# fetch-suitesparse.sh DIR: puts the source of SuiteSparse's LGPL and BSD parts (configuration, AMD,
# COLAMD, CHOLMOD's Core and Cholesky) into DIR/src, from Debian's source package.
#
# Needs apt and xz, no privileges. The machine's own package lists are read, never changed: a private
# deb-src list stands beside them. DIR/src appears complete or not at all, so that a run cut short can be repeated.
set -eu

[ $# -eq 1 ] || { echo 'usage: fetch-suitesparse.sh DIR' >&2; exit 2; }

is_complete() {
  for file in SuiteSparse_config/SuiteSparse_config.c AMD/Source/amd_order.c COLAMD/Source/colamd.c \
    CHOLMOD/Core/cholmod_common.c CHOLMOD/Cholesky/cholmod_factorize.c; do
    [ -s "$1/$file" ] || return 1
  done
}

mkdir -p "$1"
out=$(cd "$1" && pwd)
! is_complete "$out/src" || exit 0

work=$(mktemp -d "$out/fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/parts" "$work/download" "$work/src"

keyring=/usr/share/keyrings/debian-archive-keyring.gpg
signed_by=''
[ ! -f "$keyring" ] || signed_by="[signed-by=$keyring] "
# shellcheck disable=SC2016
apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT) $(ORIGIN)' 'Created-By: Packages' |
  awk -v option="$signed_by" '$4 == "Debian" { print "deb-src " option $1, $2, $3 }' |
  sort -u > "$work/sources.list"
[ -s "$work/sources.list" ] || {
  echo 'There are no Debian package lists on this machine: run apt-get update first.' >&2
  exit 1
}

private_apt() {
  apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts="$work/parts" \
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" \
    -o APT::Sandbox::User="$(id -un)" -o Acquire::Retries=3 "$@"
}
private_apt update
(cd "$work/download" && private_apt source --download-only suitesparse)

# Debian's patches touch only makefiles: the original archive is enough.
tar -xJf "$work"/download/suitesparse_*.orig.tar.xz -C "$work/src" --strip-components=1 --wildcards \
  '*/SuiteSparse_config/*' '*/AMD/*' '*/COLAMD/*' '*/CHOLMOD/*'
for part in ../ssget MatrixOps Modify Supernodal GPU Partition MATLAB Tcov; do
  rm -rf "$work/src/CHOLMOD/$part"
done
is_complete "$work/src" || { echo "SuiteSparse's archive lacks files CHOLMOD needs." >&2; exit 1; }
rm -rf "$out/src"
mv "$work/src" "$out/src"
