#!/usr/bin/env bash
# Makes what DDS Security needs: a CA, the rules of the domain (governance), and for each participant a certificate, a key
# and the permissions of its role. With openssl alone. What exists is kept.
set -euo pipefail
umask 077
here=$(dirname "$(realpath "$0")")
# shellcheck source=deploy/security/documents.sh
. "$here/documents.sh"

usage() {
  cat <<END
Usage: make_security.sh --out DIR [OPTION...]
  --out DIR              the CA goes to DIR/ca, each identity to DIR/NAME
  --role ROLE            one identity: sensor_source, monitor, viewer or operator; without it, one of each
  --name NAME            its name (default: the role), letters, digits, '.', '_', '-'; only with --role
  --protection KIND      sign (default) or encrypt the traffic; fixed when the CA is made
  --domains MIN-MAX      DDS domains that the rules hold for (default 0-230); fixed when the CA is made
  --valid-for TIME       of new certificates and permissions: 397d (default), 12h, 90s
  --renew                makes the named identities anew, with new keys, by the same CA
  --revoke NAME          puts NAME on the revocation list, and the list into every identity
  --force                starts over: a new CA, every identity in DIR is worthless and is removed
Exit: 0 done, 1 openssl failed, 2 wrong usage. Private keys have mode 0600. Keep DIR/ca off the machines that fly.
END
}
fail() { echo "make_security: $1" >&2; exit 2; }

out='' role='' name='' protection='' domains='' valid_for=397d renew=no force=no revoke=''
while [ $# -gt 0 ]; do
  case $1 in
    --renew) renew=yes; shift; continue ;;
    --force) force=yes; shift; continue ;;
    -h | --help) usage; exit 0 ;;
    --out | --role | --name | --protection | --domains | --valid-for | --revoke) ;;
    *) fail "unknown option '$1'; --help lists them" ;;
  esac
  [ $# -ge 2 ] || fail "option '$1' needs a value"
  case $1 in
    --out) out=$2 ;;
    --role) role=$2 ;;
    --name) name=$2 ;;
    --protection) protection=$2 ;;
    --domains) domains=$2 ;;
    --valid-for) valid_for=$2 ;;
    --revoke) revoke=$2 ;;
  esac
  shift 2
done
[ -n "$out" ] || fail "--out DIR is missing"
[ -z "$role" ] || is_role "$role" || fail "--role is '$role', allowed are: ${roles[*]}"
[ -z "$name" ] || [ -n "$role" ] || fail "--name needs --role"
[[ -z $name || $name =~ ^[A-Za-z0-9._-]{1,60}$ && $name != ca && $name != . && $name != .. ]] ||
  fail "--name is '$name', allowed are 1 to 60 letters, digits, '.', '_', '-', and not 'ca'"
[[ -z $protection || $protection == sign || $protection == encrypt ]] ||
  fail "--protection is '$protection', allowed are sign and encrypt"
[[ -z $domains || $domains =~ ^([0-9]{1,3})-([0-9]{1,3})$ && ${BASH_REMATCH[1]} -le ${BASH_REMATCH[2]} &&
  ${BASH_REMATCH[2]} -le 232 ]] || fail "--domains is '$domains', allowed is MIN-MAX within 0-232"
[[ $valid_for =~ ^([1-9][0-9]{0,5})([dhs])$ ]] || fail "--valid-for is '$valid_for', allowed is a number with d, h or s"
case ${BASH_REMATCH[2]} in d) unit_s=86400 ;; h) unit_s=3600 ;; s) unit_s=1 ;; esac
valid_s=$((BASH_REMATCH[1] * unit_s))
[ "$valid_s" -le $((ca_days * 86400)) ] || fail "--valid-for is '$valid_for', the CA itself is valid for ${ca_days}d only"

ca=$out/ca
if [ "$force" = yes ] && [ -d "$ca" ]; then
  for folder in "$out"/*/; do
    [ -f "$folder/permissions.p7s" ] || [ "$folder" = "$ca/" ] || continue
    echo "removed  $folder"
    rm -rf "$folder"
  done
fi

if [ -f "$ca/identity_ca.pem" ]; then
  made_with=$(cat "$ca/made_with")
  for asked in ${protection:+"protection=$protection"} ${domains:+"domains=$domains"}; do
    [[ " $made_with " == *" $asked "* ]] || fail "'$ca' was made with $made_with, not $asked; --force starts over"
  done
  echo "kept     $ca ($made_with)"
else
  made_with="protection=${protection:-sign} domains=${domains:-0-230}"
  make_ca "$ca" "$made_with"
  echo "made     $ca ($made_with)"
fi

if [ -n "$revoke" ]; then
  [ -f "$out/$revoke/cert.pem" ] || fail "--revoke is '$revoke', but there is no '$out/$revoke/cert.pem'"
  revoke_certificate "$ca" "$out/$revoke/cert.pem"
  for folder in "$out"/*/; do
    [ ! -f "$folder/permissions.p7s" ] || install -m 0644 "$ca/identity_crl.pem" "$folder/identity_crl.pem"
  done
  echo "revoked  $revoke; copy identity_crl.pem to every machine and restart its services"
  exit 0
fi

for each in ${role:-"${roles[@]}"}; do
  identity=$out/${name:-$each}
  if [ -f "$identity/permissions.p7s" ] && [ "$renew" = no ]; then
    echo "kept     $identity ($(subject_of "$identity/cert.pem"), until $(expiry_of "$identity/cert.pem"))"
    continue
  fi
  make_identity "$ca" "$identity" "$each" "${name:-$each}" "$valid_s"
  echo "made     $identity ($(subject_of "$identity/cert.pem"), $each, until $(expiry_of "$identity/cert.pem"))"
done
