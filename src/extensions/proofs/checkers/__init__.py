"""Checkers: each reads one certificate and decides in ball arithmetic alone.

A checker takes nothing from the search but the certificate's numbers, and takes these as exact. It
returns what it has proved, or raises `NotProvedError` with the reason.
"""
