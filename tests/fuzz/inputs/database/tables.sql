DROP TABLE result; CREATE VIEW result AS SELECT id AS point, 'a' AS name, 1.0 AS value, 2.0 AS "limit", NULL AS verdict FROM point;
