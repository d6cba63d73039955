"""The checkers: each reads one certificate and decides by ball arithmetic alone.

A checker takes nothing from the search but the certificate's numbers, which it takes as exact. It
returns what it has proved, or raises `NotProvedError` with the reason; what it cannot decide is not
proved.
"""
