# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Permissions and revocation of the enclaves of a keystore. kKeyDays is set by verbs/secure.sh.

# permissions_text /ENCLAVE PUBLISH SUBSCRIBE: PUBLISH and SUBSCRIBE are DDS topic names, one per line; * matches any characters.
permissions_text() {
  local from to
  from=$(date -u -d '1 day ago' +%Y-%m-%dT%H:%M:%S)
  # shellcheck disable=SC2154
  to=$(date -u -d "$kKeyDays days" +%Y-%m-%dT%H:%M:%S)
  cat <<EOT
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="$1">
      <subject_name>CN=$1</subject_name>
      <validity>
        <not_before>$from</not_before>
        <not_after>$to</not_after>
      </validity>
      <allow_rule>
        <domains>
          <id_range><min>0</min><max>232</max></id_range>
        </domains>
        <publish><topics>$(topic_tags "$2")</topics></publish>
        <subscribe><topics>$(topic_tags "$3")</topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
EOT
}

topic_tags() { sort -u <<<"$1" | sed -n 's|..*|<topic>&</topic>|p' | tr -d '\n'; }

# system_rights FILE CONTAINER: sets rights_publish and rights_subscribe from the output of `panvo_run --describe` in FILE. They start with the
# topics of every process: log, diagnostics, parameter events, clock and node discovery of ROS 2.
system_rights() {
  local current='' kind name services=on nodes=()
  rights_publish=$'ros_discovery_info\nrt/rosout\nrt/diagnostics\nrt/parameter_events'
  rights_subscribe=$'ros_discovery_info\nrt/clock'
  while read -r kind name; do
    [[ $kind != container ]] || { current=$name; continue; }
    [[ $current == "$2" ]] || continue
    case $kind in
      publishes) rights_publish+=$'\n'rt$name ;;
      subscribes) rights_subscribe+=$'\n'rt$name ;;
      reads_all) rights_subscribe+=$'\n''rt/*' ;;
      has_source) rights_publish+=$'\n'rt/clock ;;
      node) nodes+=("$name") ;;
      services) services=$name ;;
    esac
  done <"$1"
  [[ $services == on ]] || return 0
  for name in "${nodes[@]}"; do
    rights_subscribe+=$'\n'"rq$name/*Request"
    rights_publish+=$'\n'"rr$name/*Reply"$'\n'"rt$name/transition_event"
  done
}

# enclave_word TEXT: replaces characters that are invalid in enclave names by underscores.
enclave_word() { printf '%s' "${1//[^A-Za-z0-9]/_}"; }

# make_system_enclaves KEYSTORE SYSTEM [ARGUMENT...]: creates an enclave per container, /SYSTEM/CONTAINER, with the permissions its components need.
make_system_enclaves() {
  local keystore=$1 described system container name folder
  shift
  resolve_system "$@"  # fills resolved_arguments
  described=$(mktemp)
  # shellcheck disable=SC2064  # expand the name now
  trap "rm -f '$described'" EXIT
  [[ -x $(build_folder)/panvo_bin/panvo_run ]] || ensure_built panvo_programs
  use_plugins
  # shellcheck disable=SC2154
  "$(program panvo_run)" "${resolved_arguments[@]}" --describe >"$described" ||
    fail "cannot determine the permissions of $1: its components cannot be constructed here (see above); run this where its devices and files are"
  system=$(basename "$(system_file "$1")" .yaml)
  while read -r container; do
    name=/$(enclave_word "$system")/$(enclave_word "$container")
    folder=$keystore/enclaves$name
    mkdir -p "$folder"
    system_rights "$described" "$container"
    rm -f "$folder/permissions.p7s"  # first: it never belongs to other permissions than those beside it
    write_text "$folder/permissions.xml" permissions_text "$name" "$rights_publish" "$rights_subscribe"
    make_enclave "$keystore" "$name"
    note "$name has the permissions that container $container of $system needs"
  done < <(sed -n 's/^container //p' "$described")
}

# revoke KEYSTORE /ENCLAVE...: processes started afterwards reject the keys of these enclaves.
revoke() {
  local keystore=$1 enclave authority=$1/private/revocation
  shift
  [[ -e $keystore/private/ca.key.pem ]] || fail "$keystore has no private/ca.key.pem: revoke keys where they were created" 2
  for enclave in "$@"; do
    [[ -e $keystore/enclaves$enclave/cert.pem ]] || fail "$keystore has no keys of $enclave" 2
  done
  mkdir -p "$authority"
  [[ -e $authority/index.txt ]] || : >"$authority/index.txt"
  [[ -e $authority/number ]] || echo 01 >"$authority/number"
  printf '%s\n' '[ca]' 'default_ca=panvo' '[panvo]' "database=$authority/index.txt" "crlnumber=$authority/number" \
    'default_md=sha256' "default_crl_days=$kKeyDays" "certificate=$keystore/public/identity_ca.cert.pem" \
    "private_key=$keystore/private/identity_ca.key.pem" 'unique_subject=no' >"$authority/openssl.cnf"
  for enclave in "$@"; do
    run_openssl ca -config "$authority/openssl.cnf" -revoke "$keystore/enclaves$enclave/cert.pem"
    rm -r "$keystore/enclaves$enclave"
    note "revoked the keys of $enclave"
  done
  run_openssl ca -config "$authority/openssl.cnf" -gencrl -out "$keystore/public/identity_ca.crl.pem"
  tell_enclaves "$keystore"
  note "copy $keystore/enclaves and $keystore/public to every machine and restart every process: running ones do not check again"
}

# tell_enclaves KEYSTORE: links the revocation list into every enclave.
tell_enclaves() {
  local key folder
  [[ -e $1/public/identity_ca.crl.pem ]] || return 0
  while read -r key; do
    folder=$(dirname "$key")
    ln -sfn "$(realpath -m --relative-to="$folder" "$1")/public/identity_ca.crl.pem" "$folder/crl.pem"
  done < <(find "$1/enclaves" -name key.pem)
}
