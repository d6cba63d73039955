"""Validate an unpacked archive as a Provenance Run Crate, without a network.

Runs in an environment with roc-validator and rocrate, of which the second has a copy of the
context that the first would fetch. It is the copy of version 1.3, which has other addresses for
the terms of Bioschemas than the version 1.1 that the profile needs; these are replaced.
Arguments: the folder, and the least severity that counts.
"""

import io
import sys
import urllib.request
from email.message import Message
from pathlib import Path
from urllib.response import addinfourl

import requests
import rocrate
from rocrate_validator import models, services
from urllib3 import HTTPResponse

CONTEXT = (Path(rocrate.__file__).parent / "data" / "ro-crate.jsonld").read_bytes()
CONTEXT = CONTEXT.replace(b"https://bioschemas.org/terms/", b"https://bioschemas.org/")


def _open(_opener, request, *_args, **_settings):
    """Answer urllib."""
    url = request if isinstance(request, str) else request.full_url
    return addinfourl(io.BytesIO(_answer(url)), Message(), url, 200)


def _send(adapter, request, **_settings):
    """Answer requests."""
    body = io.BytesIO(_answer(request.url))
    headers = {"Content-Type": "application/ld+json"}
    response = HTTPResponse(body, headers, 200, preload_content=False)
    return adapter.build_response(request, response)


def _answer(url: str) -> bytes:
    if not url.startswith("https://w3id.org/ro/crate/"):
        raise requests.ConnectionError(f"no network: {url}")
    return CONTEXT


urllib.request.OpenerDirector.open = _open
requests.adapters.HTTPAdapter.send = _send
settings = services.ValidationSettings(
    rocrate_uri=sys.argv[1],
    profile_identifier="provenance-run-crate",
    requirement_severity=models.Severity[sys.argv[2]],
)
result = services.validate(settings)
for issue in result.get_issues():
    print(issue.severity.name, issue.check.identifier, issue.violatingEntity, issue.message)
print(len(list(result.get_issues())), "issues")
sys.exit(result.has_issues())
