WITH RECURSIVE n(k) AS (SELECT 20 UNION ALL SELECT k + 1 FROM n WHERE k < 60) INSERT INTO point SELECT k, '{"platform.mass": ' || k % 3 || ', "leg.1.drive": 2}', 'out_of_reach', k / 7.0, 'leg ' || k % 9 FROM n; UPDATE sweep SET points = 100, design = 'sobol';
INSERT INTO result SELECT id, 'kappa', id * 1e300, 1, NULL FROM point WHERE id > 19;
