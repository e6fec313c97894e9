# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# The libraries of another architecture, unpacked into build/sysroot-ARCH to compile and link against. Needs neither root nor changes to the
# packages of this machine: apt resolves and downloads with lists and state of its own, dpkg-deb unpacks. Needs packages.sh.


# ensure_sysroot ARCH: creates or refreshes build/sysroot-ARCH if it does not hold what packages.txt lists.
ensure_sysroot() {
  local arch=$1 root=$PANVO_HOME/build/sysroot-$1 wanted stamp log
  wanted=$(sysroot_packages | sort | xargs)
  stamp="$root: $wanted"
  [[ $(cat "$root/.panvo_packages" 2>/dev/null) != "$stamp" ]] || return 0
  if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
    fail "cross-compiling takes the $arch libraries from Debian packages, and apt-get or dpkg-deb is missing: build on Debian 12"
  fi
  mkdir -p "$root.apt" || fail "'$root.apt' cannot be written: build in a checkout of your own"
  # One at a time.
  exec {sysroot_lock}>"$root.apt/lock"
  flock "$sysroot_lock"
  log=$root.apt/log
  if [[ $(cat "$root/.panvo_packages" 2>/dev/null) != "$stamp" ]]; then
    note "unpacking the $arch libraries into build/sysroot-$arch (log: $log)"
    download_packages "$arch" "$root.apt" "$wanted" >"$log" 2>&1 || {
      tail -n 20 "$log" >&2
      fail "downloading the $arch packages failed; full log: $log. The mirror must have $arch: name one in a file of the format of sources.list with
  PANVO_APT_SOURCES=FILE panvo build --arch $arch"
    }
    rm -rf -- "$root.new"
    { unpack_packages "$root.apt" "$root.new" && name_root "$root.new" "$root"; } >>"$log" 2>&1 || {
      tail -n 20 "$log" >&2
      fail "unpacking the $arch packages failed; full log: $log. To start again: rm -r $root.apt"
    }
    printf '%s\n' "$stamp" >"$root.new/.panvo_packages"
    rm -rf -- "$root"
    mv "$root.new" "$root"
    rm -rf -- "$root.apt/cache"
  fi
  exec {sysroot_lock}>&-
}

# sysroot_packages: of the packages of a build, those with headers and libraries; the others are tools, which run on this machine.
sysroot_packages() { packages_of build | sed 's/|.*//' | grep -e '-dev$'; }  # of Debian 12

# download_packages ARCH FOLDER PACKAGES: these packages and all that they depend on, into FOLDER/cache/archives.
download_packages() {
  local arch=$1 folder=$2
  local -a names
  read -r -a names <<<"$3"
  rm -rf -- "$folder/state" "$folder/cache"
  mkdir -p "$folder"/{state/lists/partial,cache/archives/partial}
  : >"$folder/state/status"
  cat >"$folder/apt.conf" <<EOT
#clear APT::Architectures;
#clear APT::Update::Post-Invoke;
#clear DPkg::Post-Invoke;
APT::Architecture "$arch";
APT::Architectures { "$arch"; };
APT::Sandbox::User "";
APT::Get::Assume-Yes "true";
Acquire::Languages "none";
Dir::State "$folder/state";
Dir::State::status "$folder/state/status";
Dir::Cache "$folder/cache";
EOT
  if [[ -n ${PANVO_APT_SOURCES:-} ]]; then
    printf 'Dir::Etc::sourcelist "%s";\nDir::Etc::sourceparts "-";\n' "$(readlink -m -- "$PANVO_APT_SOURCES")" >>"$folder/apt.conf"
  fi
  # Sources of this machine without packages for that architecture only cause warnings.
  APT_CONFIG=$folder/apt.conf apt-get update -q || true
  APT_CONFIG=$folder/apt.conf apt-get install -q --no-install-recommends --download-only "${names[@]}"
}

# unpack_packages FOLDER ROOT: unpacks what download_packages fetched into ROOT, with links that lead to files in ROOT.
unpack_packages() {
  local folder=$1 root=$2 package link
  mkdir -p "$root/usr"/{lib,bin,sbin} || return
  for link in lib bin sbin; do ln -s "usr/$link" "$root/$link" || return; done
  for package in "$folder"/cache/archives/*.deb; do
    # The data archive follows links to folders, as dpkg does.
    dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink --no-same-owner -C "$root" || return
  done
  while IFS= read -r link; do
    ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$root$(readlink "$link")")" "$link" || return
  done < <(find "$root" -type l -lname '/*')
  link_alternatives "$root"
}

# link_alternatives ROOT: the links to BLAS and LAPACK that the packages' scripts would create by update-alternatives; the last one wins.
link_alternatives() {
  local folder library
  for folder in blas lapack atlas; do
    for library in "$1"/usr/lib/*/"$folder"/lib{blas,lapack}.so*; do
      [[ ! -e $library ]] || ln -sfn "$folder/${library##*/}" "${library%/*/*}/${library##*/}" || return
    done
  done
}

# name_root FOLDER ROOT: in the CMake files in FOLDER, which will be ROOT, replaces absolute paths: they would lead to libraries of this machine.
name_root() {
  find "$1/usr" -name '*.cmake' -exec grep -lZE '[";]/usr["/;]' {} + | xargs -0r sed -i -E "s|([\";])/usr([\"/;])|\\1$2/usr\\2|g"
}
