# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: create keys for encrypted communication (DDS Security); only key holders can join

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"
source "$PANVO_SCRIPTS/lib/permissions.sh"

readonly kKeyDays=3650

verb_usage() {
  cat <<'EOT'
usage: panvo secure KEYSTORE [/ENCLAVE ...]
       panvo secure KEYSTORE --system SYSTEM [--dataset DIR | --bag DIR] [NAME:=VALUE ...]
       panvo secure revoke KEYSTORE /ENCLAVE ...

Creates a keystore for DDS Security, in the layout of SROS 2, with keys for each enclave (one or more processes with the same
permissions; default: /panvo). Existing files are kept, so enclaves can be added later. Use it with

  panvo run SYSTEM --secure KEYSTORE [--enclave /ENCLAVE]

All messages are encrypted; processes without keys of this keystore can neither read nor write. Copy KEYSTORE/enclaves and
KEYSTORE/public to other machines. Keep KEYSTORE/private secret: it holds the signing key.

--system: each container of the system gets its own enclave, /SYSTEM/CONTAINER, with permission only for the topics and services of its
components; panvo run selects it automatically. The components are constructed briefly, so their devices and files must be present. After
a change of the system, run this again: keys are kept, permissions are rewritten. Enclaves named on the command line have all permissions;
use them for tools and tests.

revoke: processes started from then on reject the keys of the enclave. Create the enclave again to get new keys. Copy
KEYSTORE/enclaves and KEYSTORE/public to the other machines and restart all processes.

Between panvo's processes only: with Fast DDS 2.9 (Debian 12), secured ROS 2 nodes of Humble and Jazzy (Fast DDS 2.6.11 and 2.14.6) are not
reached, though they accept the keystore. Protect such a network below DDS, for example by a VPN.

The permissions of an enclave are in its permissions.xml. After editing it, delete its permissions.p7s and run this command again.
EOT
}

verb_main() {
  (($#)) || fail "name the folder of the keystore: panvo secure KEYSTORE [/ENCLAVE ...]" 2
  command -v openssl >/dev/null || fail "openssl not found; install the package openssl"
  umask 077
  if [[ $1 == revoke ]]; then
    (($# >= 3)) || fail "name the keystore and the enclaves to revoke: panvo secure revoke KEYSTORE /ENCLAVE ..." 2
    require_enclaves "${@:3}"
    revoke "${@:2}"
    return
  fi
  local keystore=$1 enclave
  shift
  if [[ ${1:-} == --system ]]; then
    require_value "$@"
    make_keystore "$keystore"
    make_system_enclaves "$keystore" "${@:2}"
    return
  fi
  (($#)) || set -- /panvo
  require_enclaves "$@"
  make_keystore "$keystore"
  for enclave in "$@"; do
    make_enclave "$keystore" "$enclave"
  done
}

require_enclaves() {
  local enclave
  for enclave in "$@"; do
    [[ $enclave =~ ^/[A-Za-z0-9_]+(/[A-Za-z0-9_]+)*$ ]] ||
      fail "invalid enclave name '$enclave': use /name or /name/name, of letters, digits and underscores" 2
  done
}

# make_keystore KEYSTORE: creates the certificate authority for identities and permissions, and the governance file.
make_keystore() {
  local keystore=$1
  mkdir -p "$keystore"/{private,public,enclaves}
  [[ -e $keystore/.gitignore ]] || printf '*\n' >"$keystore/.gitignore"  # keep keys out of repositories
  if [[ -e $keystore/public/ca.cert.pem && ! -e $keystore/private/ca.key.pem ]]; then
    fail "$keystore has no private/ca.key.pem: create enclaves where the keystore was created" 2
  fi
  [[ -e $keystore/private/ca.key.pem ]] || make_key "$keystore/private/ca.key.pem"
  if [[ ! -e $keystore/public/ca.cert.pem ]]; then
    write_openssl "$keystore/public/ca.cert.pem" req -new -x509 -sha256 -days "$kKeyDays" -key "$keystore/private/ca.key.pem" \
      -config <(printf '%s\n' '[req]' 'distinguished_name=name' 'x509_extensions=authority' 'prompt=no' '[name]' 'CN=panvo authority' \
        '[authority]' 'basicConstraints=critical,CA:true' 'subjectKeyIdentifier=hash')
    note "created a keystore in $keystore"
  fi
  local authority
  for authority in identity_ca permissions_ca; do
    ln -sfn ca.key.pem "$keystore/private/$authority.key.pem"
    ln -sfn ca.cert.pem "$keystore/public/$authority.cert.pem"
  done
  [[ -e $keystore/enclaves/governance.xml ]] || write_text "$keystore/enclaves/governance.xml" governance_text
  [[ -e $keystore/enclaves/governance.p7s ]] || sign "$keystore" "$keystore/enclaves/governance"
}

# make_enclave KEYSTORE /ENCLAVE
make_enclave() {
  local keystore=$1 name=$2 folder=$1/enclaves$2 up
  mkdir -p "$folder"
  up=$(realpath -m --relative-to="$folder" "$keystore")
  ln -sfn "$up/public/identity_ca.cert.pem" "$folder/identity_ca.cert.pem"
  ln -sfn "$up/public/permissions_ca.cert.pem" "$folder/permissions_ca.cert.pem"
  ln -sfn "$up/enclaves/governance.p7s" "$folder/governance.p7s"
  [[ -e $folder/key.pem ]] || make_key "$folder/key.pem"
  if [[ ! -e $folder/cert.pem ]]; then
    write_openssl "$folder/request.pem" req -new -sha256 -key "$folder/key.pem" \
      -config <(printf '%s\n' '[req]' 'distinguished_name=name' 'prompt=no' '[name]' "CN=$name")
    write_openssl "$folder/cert.pem" x509 -req -sha256 -days "$kKeyDays" -in "$folder/request.pem" -CA "$keystore/public/identity_ca.cert.pem" \
      -CAkey "$keystore/private/identity_ca.key.pem" -set_serial "0x$(openssl rand -hex 8)"
    rm "$folder/request.pem"
    note "created the keys of enclave $name"
  fi
  [[ -e $folder/permissions.xml ]] || write_text "$folder/permissions.xml" permissions_text "$name" '*' '*'
  [[ -e $folder/permissions.p7s ]] || sign "$keystore" "$folder/permissions"
  tell_enclaves "$keystore"
}

make_key() { write_openssl "$1" ecparam -name prime256v1 -genkey -noout; }

# sign KEYSTORE FILE: signs FILE.xml and writes FILE.p7s.
sign() {
  write_openssl "$2.p7s" smime -sign -text -in "$2.xml" -signer "$1/public/permissions_ca.cert.pem" \
    -inkey "$1/private/permissions_ca.key.pem"
}

run_openssl() {
  local said
  said=$(openssl "$@" 2>&1) || fail "openssl $1 failed: $said"
}

# write_openssl FILE ARGUMENT...: FILE is there once it is complete; after an interruption or a full disk, the command can be repeated.
write_openssl() {
  local file=$1
  shift
  run_openssl "$@" -out "$file.new"
  mv -f -- "$file.new" "$file"
}

# write_text FILE COMMAND...: the same for the output of a command.
write_text() {
  local file=$1
  shift
  "$@" >"$file.new" || fail "cannot write $file"
  mv -f -- "$file.new" "$file"
}

governance_text() {
  cat <<'EOT'
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains>
        <id_range><min>0</min><max>232</max></id_range>
      </domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
EOT
}
