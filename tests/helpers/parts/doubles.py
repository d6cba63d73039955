"""Doubles on their way to a page and back."""

import base64
import hashlib
import math

import numpy as np

# Reads and writes arrays of doubles as base64, so that NaN, infinity and -0 pass unchanged.
SCRIPT = """
const floats = text => new Float64Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const text = array => {
  const bytes = pseudorigid.bytesOf(array);
  let result = "";
  for (let i = 0; i < bytes.length; i += 30000) {
    result += String.fromCharCode(...bytes.subarray(i, i + 30000));
  }
  return btoa(result);
};
Object.assign(globalThis, { floats, text }); // scripts of tests see only these
"""


def packed(array):
    return base64.b64encode(np.ascontiguousarray(array, dtype="<f8").tobytes()).decode()


def bits(array):
    """The bits of doubles, every NaN the same."""
    array = np.array(array, dtype=float)
    array[np.isnan(array)] = math.nan
    return array.view(np.uint64)


def unpacked(text):
    return np.frombuffer(base64.b64decode(text))


def digest(array):
    return hashlib.sha256(bits(array).tobytes()).hexdigest()
