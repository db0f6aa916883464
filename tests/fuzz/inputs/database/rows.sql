UPDATE point SET verdict = 'fail', seconds = 'x' WHERE id = 3; UPDATE point SET parameters = '{"platform.mass": null}' WHERE id = 4;
DELETE FROM result WHERE point = 5; INSERT INTO result VALUES(2, 'nothing', 9e999, -1e-310, 'pass');
