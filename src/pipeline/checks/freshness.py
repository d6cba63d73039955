"""Whether results are what this tree would make: by their records, never by their times."""

from functools import cache

from ..records.differences import differing_block, differing_files, differing_package
from ..records.files import file_hash, obstacle
from ..records.record import RecordError, read_record, record_path, refusal_path, versions
from ..records.sources import syntax_hash

MISSING = "missing"
DAMAGED = "changed after it was made"


class Freshness:
    """What this tree has to make again.

    Parameters
    ----------
    root : pathlib.Path
    build_specs : dict
        Result -> BuildSpec, for every result that may be asked about.
    """

    def __init__(self, root, build_specs):
        self.root, self.build_specs = root, build_specs
        self.digest = cache(lambda path: file_hash(root / path))
        self.syntax_hash = cache(lambda path: syntax_hash(root / path))
        self.packages = versions()
        self.own_reason = cache(self._own_reason)
        self.reason = cache(self._reason)
        self.refusal = cache(self._refusal)

    def outdated(self, paths=None):
        """What has to be made again.

        Parameters
        ----------
        paths : iterable of str, optional
            Results; by default all.

        Returns
        -------
        dict of str to str
            Result -> why, in words.
        """
        reasons = {
            path: self.reason(path) for path in (self.build_specs if paths is None else paths)
        }
        return {path: why for path, why in reasons.items() if why}

    def _refusal(self, path):
        """Why a result cannot exist, as a job for it or for an input found, in words, or None."""
        made = self.build_specs[path]
        for used in made.inputs:
            if used in self.build_specs and (why := self.refusal(used)):
                return why
        try:
            record = read_record(self.root, refusal_path(path))
        except RecordError:
            return None
        return None if self._difference(record, made) else str(record["output"].get("refused"))

    def _reason(self, path):
        """Why a result has to be made again, in words (MISSING where there is none), or None."""
        if why := self.refusal(path):
            return f"cannot exist: {why}"
        if why := self.own_reason(path):
            return why
        for used in self.build_specs[path].inputs:
            if used in self.build_specs and (why := self.reason(used)):
                return f"made from {used}, which is {MISSING if why == MISSING else 'not current'}"
        return None

    def _own_reason(self, path):
        """Why a result has to be made again even if its inputs keep their bytes, or None."""
        made = self.build_specs[path]
        if self.digest(path) is None:
            return obstacle(self.root / path) or MISSING
        try:
            record = read_record(self.root, record_path(path))
        except RecordError as error:
            return str(error)
        if self.digest(path) != record["output"]["sha256"]:
            return DAMAGED
        return self._difference(record, made)

    def _difference(self, record, made):
        """How what a record says that made its result differs from what would make it now."""
        if words := differing_block(record["config"], made.config):
            return f"made from another config: {words}"
        here = {file: self.syntax_hash(file) for file in made.sources}
        if words := differing_files(record["sources"], here):
            return f"made by other code than this tree's: {words}"
        if words := differing_package(record["environment"], self.packages):
            return f"made with {words}"
        inputs = {used: self.digest(used) for used in made.inputs}
        if words := differing_files(record["inputs"], inputs):
            return f"made from another {words.split()[0]}"
        return None
