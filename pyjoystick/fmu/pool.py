"""Pools of what runs an FMU: made on demand, lent to one user at a time and reused."""

from __future__ import annotations

import os
import threading
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Generic, TypeVar

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.support import PyJoystickError

T = TypeVar("T")


class Pool(ABC, Generic[T]):
    """Instances of an FMU, or processes that run it.

    Attributes:
        description: the FMU
    """

    #: Whether only one may be taken at a time, so that others wait.
    has_one = False
    #: Whether a forked process can use its parent's idle members.
    survives_fork = True

    def __init__(self, description: FmuDescription) -> None:
        """Make the first member, to verify that the FMU can be run; closes the pool if it cannot."""
        self.description = description
        self._process = self._maker = os.getpid()
        self._state = threading.Condition()
        self._taken = 0
        self._closed = False
        self._idle: list[T] = []
        try:
            self._idle.append(self._make())
        except BaseException:
            self._put_away()
            raise

    def take(self) -> T:
        """Take a member for exclusive use until it is given back.

        Raises:
            PyJoystickError: the pool has been closed
            FmuFileError: the FMU cannot be instantiated again
        """
        with self._state:
            while self.has_one and self._taken and not self._closed:
                self._state.wait()
            if self._closed:
                raise PyJoystickError(f"{self.description.path} has been closed")
            self._taken += 1
            self._leave_those_of_the_parent()
            one = self._idle.pop() if self._idle else None
        if one is not None:
            return one
        try:
            return self._make()
        except BaseException:
            self._return(None)
            raise

    def give_back(self, one: T) -> None:
        """Keep a member for the next user; free it if it is unusable or the pool is closed."""
        if self.is_reusable(one):
            self._return(one)
        else:
            # Free it before another one is made: there may be room for only one.
            self._free(one)
            self._return(None)

    @contextmanager
    def lent(self) -> Iterator[T]:
        """Take a member and give it back at the end."""
        one = self.take()
        try:
            yield one
        finally:
            self.give_back(one)

    def close(self) -> None:
        """Free idle members now and the others when they are given back; may be called more than once."""
        if os.getpid() != self._process and self.survives_fork:
            return  # forked: the members and the unpacked files belong to the parent
        with self._state:
            if self._closed:
                return
            self._closed = True
            self._leave_those_of_the_parent()
            while self._idle:
                self._free(self._idle.pop())
            self._put_away_if_unused()
            self._state.notify_all()

    def _return(self, one: T | None) -> None:
        with self._state:
            self._taken -= 1
            if one is not None and self._closed:
                self._free(one)
            elif one is not None:
                self._idle.append(one)
            self._put_away_if_unused()
            self._state.notify()

    def _leave_those_of_the_parent(self) -> None:
        """In a forked process, forget members that do not survive a fork; this process makes its own."""
        if not self.survives_fork and os.getpid() != self._maker:
            self._maker = os.getpid()
            self._idle.clear()

    def _put_away_if_unused(self) -> None:
        # The unpacked files belong to the process that made the pool.
        if self._closed and not self._taken and os.getpid() == self._process:
            self._put_away()

    @abstractmethod
    def _make(self) -> T:
        """Make another member."""

    @abstractmethod
    def is_reusable(self, one: T) -> bool:
        """Whether a member may be used again."""

    @abstractmethod
    def _free(self, one: T) -> None:
        """Discard a member that cannot be used again."""

    @abstractmethod
    def _put_away(self) -> None:
        """Delete what all members share."""
