import numpy as np
import ursula

s = ursula.read_scenario("my.toml")

def mine(m):  # N instants: m.t, m.p, m.q, m.v, m.w, m.a, m.alpha
    return np.zeros((len(m.t), 6))  # your code: six efforts for each instant

r = ursula.validate(s, solver=mine)
print(r.verdict, r.summary["reason"])
print(r.cause)  # None where it passes, or where no cause alone explains it
r.write("results/mine")
