"""What check() returns."""


class Checked(list):
    """Warnings, a list of sentences. `blind` is a list of mistakes that the scenario cannot show: dicts with mistake, cause and largest,
    as in `ursula check --json`; None if this build knows no mistakes."""

    def __init__(self, warnings, blind):
        super().__init__(warnings)
        self.blind = blind
