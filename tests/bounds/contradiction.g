# What no script may be: its hypotheses exclude each other, so Gappa proves whatever is asked.
{ x in [1,2] /\ x in [3,4] -> x in [5,6] }
