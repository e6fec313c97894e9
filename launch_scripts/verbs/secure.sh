# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: make the keys with which only one's own processes speak and listen

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"
source "$PANVO_SCRIPTS/lib/permissions.sh"

readonly kKeyDays=3650

verb_usage() {
  cat <<'EOT'
usage: panvo secure KEYSTORE [/ENCLAVE ...]
       panvo secure KEYSTORE --system SYSTEM [--dataset DIR | --bag DIR] [NAME:=VALUE ...]
       panvo secure revoke KEYSTORE /ENCLAVE ...

Makes a keystore for DDS Security, laid out as SROS 2's, and in it the keys of each enclave (a process or several that may do the same);
/panvo where none is named. What is there already stays, so that enclaves can be added later. Then:

  panvo run SYSTEM --secure KEYSTORE [--enclave /ENCLAVE]

and for ROS 2 nodes ROS_SECURITY_KEYSTORE=KEYSTORE ROS_SECURITY_ENABLE=true ROS_SECURITY_STRATEGY=Enforce, and their own enclave.
Who has no keys of this keystore neither reads nor writes; all that is sent is encrypted. Other machines need KEYSTORE/enclaves and
KEYSTORE/public; keep KEYSTORE/private, with which keys are made, to yourself.

With --system each container of that system gets an enclave of its own, /SYSTEM/CONTAINER, which may read, write and serve what its components do
and no more; panvo run takes it by itself. The components are made for a moment, so that their devices and files must be there. When the system
has changed, run it again: keys stay, rights are written anew. Enclaves that are named instead may do everything: for tools, and for trials.

revoke: who has the keys of that enclave is refused by all processes that are started from then on; make the enclave again for new keys. Copy
KEYSTORE/enclaves and KEYSTORE/public to the other machines, and start everything anew.

What an enclave may read and write stands in its permissions.xml; after changing it, take away its permissions.p7s and run this again.
EOT
}

verb_main() {
  (($#)) || fail "name the folder of the keystore: panvo secure KEYSTORE [/ENCLAVE ...]" 2
  command -v openssl >/dev/null || fail "there is no openssl; install the package openssl"
  umask 077
  if [[ $1 == revoke ]]; then
    (($# >= 3)) || fail "name the keystore and what to revoke: panvo secure revoke KEYSTORE /ENCLAVE ..." 2
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
      fail "'$enclave' is no enclave: write a name, or several, each with a slash before it, of letters, digits and underscores" 2
  done
}

# make_keystore KEYSTORE: the authority that signs identities and permissions, and the rules that hold for all.
make_keystore() {
  local keystore=$1
  mkdir -p "$keystore"/{private,public,enclaves}
  [[ -e $keystore/.gitignore ]] || printf '*\n' >"$keystore/.gitignore"  # keys do not go into anybody's repository
  if [[ ! -e $keystore/private/ca.key.pem ]]; then
    make_key "$keystore/private/ca.key.pem"
    run_openssl req -new -x509 -sha256 -days "$kKeyDays" -key "$keystore/private/ca.key.pem" -out "$keystore/public/ca.cert.pem" \
      -config <(printf '%s\n' '[req]' 'distinguished_name=name' 'x509_extensions=authority' 'prompt=no' '[name]' 'CN=panvo authority' \
        '[authority]' 'basicConstraints=critical,CA:true' 'subjectKeyIdentifier=hash')
    note "made a keystore in $keystore"
  fi
  local authority
  for authority in identity_ca permissions_ca; do
    ln -sfn ca.key.pem "$keystore/private/$authority.key.pem"
    ln -sfn ca.cert.pem "$keystore/public/$authority.cert.pem"
  done
  [[ -e $keystore/enclaves/governance.xml ]] || governance_text >"$keystore/enclaves/governance.xml"
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
  if [[ ! -e $folder/key.pem ]]; then
    make_key "$folder/key.pem"
    run_openssl req -new -sha256 -key "$folder/key.pem" -out "$folder/request.pem" \
      -config <(printf '%s\n' '[req]' 'distinguished_name=name' 'prompt=no' '[name]' "CN=$name")
    run_openssl x509 -req -sha256 -days "$kKeyDays" -in "$folder/request.pem" -CA "$keystore/public/identity_ca.cert.pem" \
      -CAkey "$keystore/private/identity_ca.key.pem" -set_serial "0x$(openssl rand -hex 8)" -out "$folder/cert.pem"
    rm "$folder/request.pem"
    note "made the keys of enclave $name"
  fi
  [[ -e $folder/permissions.xml ]] || permissions_text "$name" '*' '*' >"$folder/permissions.xml"
  [[ -e $folder/permissions.p7s ]] || sign "$keystore" "$folder/permissions"
  tell_enclaves "$keystore"
}

make_key() { run_openssl ecparam -name prime256v1 -genkey -noout -out "$1"; }

# sign KEYSTORE FILE: FILE.xml, signed, as FILE.p7s.
sign() {
  run_openssl smime -sign -text -in "$2.xml" -out "$2.p7s" -signer "$1/public/permissions_ca.cert.pem" \
    -inkey "$1/private/permissions_ca.key.pem"
}

run_openssl() {
  local said
  said=$(openssl "$@" 2>&1) || fail "openssl $1 failed: $said"
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
