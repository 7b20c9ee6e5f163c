# SPDX-License-Identifier: Apache-2.0
# Sourced by make_security.sh: certificates, governance and permissions, and which role may do what.
# Documents follow OMG DDS Security 1.1, chapter 9.4; they hold no XML comments, because parsers differ about them.
# shellcheck disable=SC2034,SC2154  # variables of make_security.sh and authority.sh

roles=(sensor_source monitor viewer operator)
ca_days=3650
back_date_s=3600 # clocks of other machines may be behind by so much

is_role() { [[ " ${roles[*]} " == *" $1 "* ]]; }

# Least privilege, topic by topic. A reader holds the key of the writers that it reads, so who need not read sensors must not.
may_publish() {
  case $1 in
    sensor_source) echo EngineSensors EngineDescription EngineTruth CommandReply ;;
    monitor) echo EngineHealth 'EngineHealth/*' EngineAuxiliary 'EngineAuxiliary/*' EngineResiduals EngineDescription \
      MonitorStatus HealthEvent FlightSummary CommandReply ;;
    viewer) ;;
    operator) echo MonitorCommand SimCommand ;;
  esac
}
may_subscribe() {
  local shown='EngineHealth EngineHealth/* EngineAuxiliary EngineAuxiliary/* EngineResiduals EngineDescription MonitorStatus HealthEvent FlightSummary EngineTruth'
  case $1 in
    sensor_source) echo SimCommand EngineResiduals ;;
    monitor) echo EngineSensors EngineDescription EngineHealth MonitorCommand ;; # EngineHealth: of its partner
    viewer) echo "$shown" ;;
    operator) echo "$shown CommandReply" ;;
  esac
}

# utc SECONDS FORMAT: so many seconds from now.
utc() { date -u -d "@$(($(date +%s) + $1))" "+$2"; }
# read_certificate FILE: sets serial, subject and until; fails if it is none.
read_certificate() {
  local lines
  lines=$(openssl x509 -in "$1" -noout -serial -subject -enddate -nameopt RFC2253 2>/dev/null) || return
  { read -r serial; read -r subject; read -r until; } <<<"$lines"
  serial=${serial#serial=} subject=${subject#subject=} until=${until#notAfter=}
}
domain_range() { sed -E 's/.*domains=([0-9]+)-([0-9]+).*/<id_range><min>\1<\/min><max>\2<\/max><\/id_range>/' <<<"$1"; }

# quietly COMMAND...: shows what it says only when it fails.
quietly() {
  local said
  said=$("$@" 2>&1) || broken "$* failed: ${said//$'\n'/; }"
}

new_key() { quietly openssl genpkey -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -pkeyopt ec_param_enc:named_curve -out "$1"; }

# On a full disk openssl leaves half a file and says nothing: what it has written is read before it counts.

# sign_document CA XML P7S: S/MIME with the content inside, as the specification asks.
sign_document() {
  quietly openssl smime -sign -in "$2" -text -out "$3" -signer "$1/permissions_ca.pem" -inkey "$1/permissions_ca.key"
  quietly openssl smime -verify -in "$3" -CAfile "$1/permissions_ca.pem" -out /dev/null
}

# make_ca DIR: two authorities (who you are, what you may), the governance, an empty register.
make_ca() {
  local ca=$1 kind
  mkdir -p "$ca/issued"
  for kind in identity permissions; do
    new_key "$ca/${kind}_ca.key"
    quietly openssl req -x509 -new -key "$ca/${kind}_ca.key" -sha256 -days "$ca_days" -out "$ca/${kind}_ca.pem" \
      -subj "/O=engine health monitor/CN=$kind authority $(openssl rand -hex 4)" \
      -addext basicConstraints=critical,CA:TRUE -addext keyUsage=critical,keyCertSign,cRLSign,digitalSignature
  done
  : >"$ca/register"
  echo 'unique_subject = no' >"$ca/register.attr"
  openssl rand -hex 16 >"$ca/serial"
  governance "$made_with" >"$ca/governance.xml"
  sign_document "$ca" "$ca/governance.xml" "$ca/governance.p7s"
  echo "$made_with" >"$ca/made_with"
}

# openssl_ca DIR OPTION...: within DIR, because its path may have characters that mean something in a configuration.
openssl_ca() { (cd "$1" && quietly openssl ca -config <(openssl_configuration) "${@:2}"); }
openssl_configuration() {
  cat <<END
[ca]
default_ca = identity
[identity]
database = ./register
serial = ./serial
new_certs_dir = ./issued
certificate = ./identity_ca.pem
private_key = ./identity_ca.key
default_md = sha256
default_crl_days = $ca_days
policy = names
x509_extensions = participant
[names]
organizationName = supplied
organizationalUnitName = supplied
commonName = supplied
[participant]
basicConstraints = critical,CA:FALSE
keyUsage = critical,digitalSignature
END
}

# Nobody without identity joins, discovery tells outsiders nothing, every topic is under access control.
# Protection is per topic, with a key for each writer. Not per RTPS message: every participant would hold that key, and
# signing there lets a forged length make Fast DDS 2.9.1 read far beyond the datagram (deploy/docs/security.md).
governance() {
  local protection=SIGN
  [[ $1 == *protection=encrypt* ]] && protection=ENCRYPT
  cat <<END
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains>$(domain_range "$1")</domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>SIGN</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>$protection</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
END
}

# rule publish|subscribe TOPIC...: the topics in the default partition (no partitions said) and in those of a fleet.
rule() {
  local action=$1 topics partitions
  shift
  [ $# -gt 0 ] || return 0
  topics=$(printf '<topic>%s</topic>' "$@")
  for partitions in '' '<partitions><partition>fleet/*</partition></partitions>'; do
    echo "        <$action><topics>$topics</topics>$partitions</$action>"
  done
}

# permissions ROLE NAME SUBJECT MADE_WITH VALID_S
permissions() {
  # shellcheck disable=SC2046
  cat <<END
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="$2">
      <subject_name>$3</subject_name>
      <validity>
        <not_before>$(utc -86400 %Y-%m-%dT%H:%M:%S)</not_before>
        <not_after>$(utc $(($5 + 86400)) %Y-%m-%dT%H:%M:%S)</not_after>
      </validity>
      <allow_rule>
        <domains>$(domain_range "$4")</domains>
$(rule publish $(may_publish "$1"))
$(rule subscribe $(may_subscribe "$1"))
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
END
}

# make_identity DIR ROLE NAME: sets `about` (for people). Permissions fit a certificate by its subject, letter by letter. So
# the subject has role and generation: permissions of another role or of an earlier key fit this key no more than this
# one's fit an earlier key.
make_identity() {
  local identity=$1 role=$2 name=$3 generation serial subject until
  generation=$(($(issued_to "$name" | wc -l) + 1))
  mkdir "$identity"
  new_key "$identity/key.pem"
  quietly openssl req -new -key "$identity/key.pem" -sha256 -out "$ca/request" \
    -subj "/O=engine health monitor/OU=$role generation $generation/CN=$name"
  openssl_ca "$ca" -batch -notext -in request -out "$identity/cert.pem" \
    -startdate "$(utc -$back_date_s %Y%m%d%H%M%SZ)" -enddate "$(utc "$valid_s" %Y%m%d%H%M%SZ)"
  rm "$ca/request"
  if ! read_certificate "$identity/cert.pem" || ! grep -q "^V.*[[:space:]]${serial}[[:space:]].*/CN=$name\$" "$ca/register" ||
    [ ! -s "$ca/serial" ]; then
    broken "'$identity/cert.pem' or its entry in the register was not written; is the disk full?"
  fi
  about="$subject, until $until"
  permissions "$role" "$name" "$subject" "$made_with" "$valid_s" >"$identity/permissions.xml"
  sign_document "$ca" "$identity/permissions.xml" "$identity/permissions.p7s"
  cp "$ca/identity_ca.pem" "$ca/permissions_ca.pem" "$ca/governance.p7s" "$identity"
  [ ! -f "$ca/identity_crl.pem" ] || cp "$ca/identity_crl.pem" "$identity"
  chmod 0755 "$identity"
  chmod 0644 "$identity"/*
  chmod 0600 "$identity/key.pem"
}

# make_list CA: of the revoked. Back-dated as certificates are: where a clock is behind, a list of the future accepts nobody.
make_list() {
  openssl_ca "$1" -gencrl -out identity_crl.pem -crl_lastupdate "$(utc -$back_date_s %Y%m%d%H%M%SZ)"
  quietly openssl crl -in "$1/identity_crl.pem" -noout
}
