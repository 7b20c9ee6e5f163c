#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes what DDS Security needs: a CA, the rules of the domain (governance), and for each participant a certificate, a key
# and the permissions of its role. With openssl alone. What exists is kept.
set -euo pipefail
shopt -s nullglob
umask 077
export LC_ALL=C # ranges of letters, and what openssl says, are the same everywhere
here=$(dirname "$(realpath "$0")")
# shellcheck source=deploy/security/documents.sh
. "$here/documents.sh"
# shellcheck source=deploy/security/authority.sh
. "$here/authority.sh"

usage() {
  cat <<END
Usage: make_security.sh --out DIR [OPTION...]
  --out DIR              the CA goes to DIR/ca, each identity to DIR/NAME
  --role ROLE            one identity: sensor_source, monitor, viewer or operator; without it, one of each
  --name NAME            its name (default: the role), letters, digits, '.', '_', '-'; only with --role or --renew
  --protection KIND      sign (default) or encrypt the traffic; fixed when the CA is made
  --domains MIN-MAX      DDS domains that the rules hold for, within 0-232 (default 0-230); fixed when the CA is made
  --valid-for TIME       of new certificates and permissions: 397d (default), 12h, 90s
  --renew                makes the named identities anew, by the same CA, and revokes what their names had before.
                         New keys; permissions of before do not fit them. With --role, the role may be another one
  --keep-old             with --renew: what the names had before stays valid, until --revoke-old
  --revoke NAME          revokes every certificate that NAME ever had, also when DIR/NAME is lost
  --revoke-old NAME      the same, except the newest
  --force                starts over: a new CA, every identity in DIR is worthless and is removed
The list of revoked certificates goes into every identity in DIR. Runs on one DIR wait for each other; one that is cut off
has changed nothing, or is completed by the next. Private keys have mode 0600. Keep DIR/ca off the machines that fly.
Exit: 0 done, 1 openssl or the file system failed, 2 wrong usage.
END
}

# One line, whatever characters a value has.
say_error() { echo "make_security: ${1//[[:cntrl:]]/?}" >&2; }
fail() { say_error "$1"; exit 2; }
broken() { say_error "$1"; exit 1; }

declare -A allowed=(
  [--out]='a folder (./-x if its name begins with a dash)'
  [--role]='sensor_source, monitor, viewer or operator'
  [--name]="1 to 60 letters, digits, '.', '_', '-', beginning with none of '.' and '-', and not 'ca'"
  [--protection]='sign or encrypt'
  [--domains]='MIN-MAX within 0-232'
  [--valid-for]='a number with d, h or s'
)
allowed[--revoke]=${allowed[--name]}
allowed[--revoke-old]=${allowed[--name]}
wrong() { fail "$1 is '${given[$1]}', allowed is ${2:-${allowed[$1]}}"; }

options='--out, --role, --name, --protection, --domains, --valid-for, --renew, --keep-old, --revoke, --revoke-old, --force, --help'
declare -A given=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --renew | --keep-old | --force) given[$1]=yes; shift; continue ;;
    --out | --role | --name | --protection | --domains | --valid-for | --revoke | --revoke-old) ;;
    *) fail "unknown argument '$1', allowed are $options" ;;
  esac
  [ $# -ge 2 ] || fail "option '$1' needs a value: ${allowed[$1]}"
  [ -z "${given[$1]+set}" ] || fail "option '$1' is given twice ('${given[$1]}', '$2'), allowed is once"
  given[$1]=$2
  [[ -n $2 && $2 != -* ]] || wrong "$1"
  shift 2
done

out=${given[--out]-} role=${given[--role]-} name=${given[--name]-} protection=${given[--protection]-}
renew=${given[--renew]-no} keep_old=${given[--keep-old]-no} force=${given[--force]-no}
revoke=${given[--revoke]-${given[--revoke-old]-}}
[ -n "$out" ] || fail "--out is missing, allowed is ${allowed[--out]}"
[[ $out != *[[:cntrl:]]* ]] || wrong --out 'a folder without control characters in its name'
[ -z "$role" ] || is_role "$role" || wrong --role
for option in --name --revoke --revoke-old; do
  [[ -z ${given[$option]-} || ${given[$option]} =~ ^[A-Za-z0-9_][A-Za-z0-9._-]{0,59}$ && ${given[$option]} != ca ]] ||
    wrong $option
done
[[ -z $protection || $protection == sign || $protection == encrypt ]] || wrong --protection
domains=''
if [ -n "${given[--domains]-}" ]; then
  [[ ${given[--domains]} =~ ^([0-9]{1,3})-([0-9]{1,3})$ ]] || wrong --domains
  domains=$((10#${BASH_REMATCH[1]}))-$((10#${BASH_REMATCH[2]})) # a leading zero is no octal number
  [[ ${domains%-*} -le ${domains#*-} && ${domains#*-} -le 232 ]] || wrong --domains
fi
valid_for=${given[--valid-for]-397d}
[[ $valid_for =~ ^([1-9][0-9]{0,8})([dhs])$ ]] || wrong --valid-for
case ${BASH_REMATCH[2]} in d) unit_s=86400 ;; h) unit_s=3600 ;; s) unit_s=1 ;; esac
valid_s=$((BASH_REMATCH[1] * unit_s))
[ "$valid_s" -le $((ca_days * 86400)) ] || wrong --valid-for "at most ${ca_days}d, as the CA itself"
if [ -n "$revoke" ]; then
  for option in "${!given[@]}"; do
    [[ $option == --out || $option == --revoke* ]] ||
      fail "$option does not go with --revoke or --revoke-old, allowed is --out"
  done
  [[ -z ${given[--revoke]-} || -z ${given[--revoke-old]-} ]] ||
    fail "--revoke and --revoke-old are given, allowed is one of them"
fi
[[ -z $name || -n $role || $renew == yes ]] || fail "--name needs --role, allowed is ${allowed[--role]}"
[[ $keep_old == no || $renew == yes ]] || fail "--keep-old needs --renew"
[[ $force == no || $renew == no ]] || fail "--force makes everything anew, and does not go with --renew"

open_authority
if [ -n "$revoke" ]; then
  revoke_name "$revoke"
elif [ -n "$role$name" ]; then
  provide "$role" "${name:-$role}" asked
else
  for each in "${roles[@]}"; do provide "$each" "$each" ''; done
fi
commit
